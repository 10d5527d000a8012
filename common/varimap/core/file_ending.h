#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace varimap {

/// Whether a file's name ends with `ending` (lower case, with its dot), in any case of letters. The same in
/// every locale.
inline bool has_ending(std::string_view path, std::string_view ending) {
    const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; };
    return path.size() >= ending.size() &&
           std::equal(ending.begin(), ending.end(), path.end() - std::ptrdiff_t(ending.size()),
                      [&](char a, char b) { return a == lower(b); });
}

}  // namespace varimap
