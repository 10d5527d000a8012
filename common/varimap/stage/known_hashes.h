#pragma once

#include <ctime>
#include <functional>
#include <string>
#include <utility>

#include "varimap/artifact/artifact.h"

namespace varimap {

/// What a file's size, times and place on the disk tell of whether it is still the same.
struct FileState {
    std::string text;
    bool operator==(const FileState&) const = default;
};
/// Throws IoError where there is no such file, or it is none: a folder, a pipe, a device.
FileState file_state(const std::string& path);

/// Content hashes of files, remembered in a folder by the files' sizes and times, so that what has not
/// changed is read once. A file is remembered only when it has been at rest for seconds by this machine's
/// clock: one that changes while it is read, or whose times lie in the future, is read every time.
class KnownHashes {
  public:
    using Clock = std::function<std::time_t()>;
    /// Remembers nothing where `folder` is empty. `now`: this machine's clock, in seconds as of std::time.
    explicit KnownHashes(
        std::string folder, Clock now = [] { return std::time(nullptr); })
        : folder_(std::move(folder)), now_(std::move(now)) {}
    /// Kind and content hash: of an artifact its own kind and the hash of its payload, read whole and
    /// checked; of any other file "file", or its ending, which tells readers its format. Throws ArtifactError
    /// (a damaged artifact), IoError.
    InputRecord identify(const std::string& role, const std::string& path) const;

  private:
    std::string folder_;
    Clock now_;
};

/// "off" for x.OFF; "file" where there is no such ending.
std::string kind_of_file(const std::string& path);

}  // namespace varimap
