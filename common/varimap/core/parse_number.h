#pragma once

#include <charconv>
#include <string_view>

namespace varimap {

/// Whether the whole text is a number of that type, which `value` then is; the same in every locale, unlike
/// std::stod.
template <class Number>
bool parse_number(std::string_view text, Number& value) {
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    return error == std::errc() && stop == end;
}

}  // namespace varimap
