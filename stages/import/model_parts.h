#pragma once

#include <string_view>

namespace varimap {

/// How many files of a 3MF, which is a zip archive, hold models. Assimp reads one of them.
int model_parts_in_3mf(std::string_view zip);

}  // namespace varimap
