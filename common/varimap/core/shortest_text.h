#pragma once

#include <charconv>
#include <string>

namespace varimap {

/// The shortest text that reads back to the same number, in every locale.
template <class Number>
std::string shortest_text(Number number) {
    char buffer[32];
    return {buffer, std::to_chars(buffer, buffer + sizeof buffer, number).ptr};
}

}  // namespace varimap
