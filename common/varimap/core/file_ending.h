#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "varimap/core/lower_case.h"

namespace varimap {

/// Whether a file's name ends with `ending` (lower case, with its dot), in any case of letters. The same in
/// every locale.
inline bool has_ending(std::string_view path, std::string_view ending) {
    return path.size() >= ending.size() &&
           std::equal(ending.begin(), ending.end(), path.end() - std::ptrdiff_t(ending.size()),
                      [](char a, char b) { return a == lower_case(b); });
}

}  // namespace varimap
