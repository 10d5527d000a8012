#pragma once

#include <cstddef>
#include <string_view>

namespace varimap {

/// `text` without the blanks at its ends, a view of it.
inline std::string_view trimmed(std::string_view text, std::string_view blanks = " \t\r") {
    const std::size_t begin = text.find_first_not_of(blanks);
    if (begin == text.npos) return {};
    return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

}  // namespace varimap
