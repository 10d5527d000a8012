#pragma once

#include <string>
#include <string_view>

namespace varimap {

/// ASCII capitals as small letters, all else as it is. The same in every locale.
constexpr char lower_case(char c) {
    return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
}
inline std::string lower_case(std::string_view text) {
    std::string lower(text);
    for (char& c : lower) c = lower_case(c);
    return lower;
}

}  // namespace varimap
