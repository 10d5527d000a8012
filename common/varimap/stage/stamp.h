#pragma once

#include <string>
#include <vector>

#include "varimap/artifact/artifact.h"

namespace varimap {

/// Whether a stage that would write the header `now` has written `then`: the same kind, schema, stage,
/// version, parameters and inputs, these in any order.
bool would_be_written(const Header& now, const Header& then);

/// What files that are no artifacts were made from: an artifact of this kind, whose header says it, beside
/// the files. Its payload lists their names and hashes.
inline constexpr const char* stamp_kind = "stamp";
inline constexpr int stamp_schema = 1;

/// A file as a stamp lists it.
struct StampedFile {
    std::string hash, name;  ///< the name within the stamp's folder
};

/// A stamp as it was read.
struct Stamp {
    Header header;
    std::vector<StampedFile> files;
};

/// Throws ArtifactError (damaged, or a name that leads out of the folder), IoError.
Stamp read_stamp(const std::string& path);
/// The files that the stamp lists; none where there is no such stamp, or a damaged one.
std::vector<std::string> paths_of_stamp(const std::string& path);
/// Writes a stamp for `files`, which lie in its folder, and removes those that the stamp before listed and
/// this one does not.
void write_stamp(const std::string& path, Header header, const std::vector<std::string>& files);

}  // namespace varimap
