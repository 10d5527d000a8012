#pragma once

#include <string>

namespace varimap {

/// What the artifact was made from, and what that was made from: an indented line for each input, with the
/// file that holds it where one lies in the same folder. Throws ArtifactError, IoError.
std::string lineage(const std::string& path);

}  // namespace varimap
