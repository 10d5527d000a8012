#pragma once

#include <optional>
#include <string>

#include "varimap/core/error.h"

namespace varimap {

/// Header, lineage and contents of an artifact, to be read by people: all of it, or what fits a screen.
/// Throws ArtifactError, IoError.
enum class Detail : int { screen, all };
std::string summarise(const std::string& path, Detail detail = Detail::all);

/// Reads and decodes all of an artifact; what is wrong with it, if anything.
std::optional<Error> check(const std::string& path);

/// Writes the artifact's arrays (.npy), sparse matrices (.mtx), surfaces (.ply) and texts into `folder`,
/// which is made where it does not exist. Throws ArtifactError, IoError.
void export_contents(const std::string& path, const std::string& folder);

}  // namespace varimap
