#pragma once

#include <string>

namespace varimap {

/// Removes what killed writers of `path` left beside it: temporary files that no process holds any more.
void remove_dead_temporaries(const std::string& path);

}  // namespace varimap
