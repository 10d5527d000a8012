#pragma once

#include <cmath>

namespace varimap {

/// Whether a number that was read as a float is whole, and an int holds it, as those of vertices and faces.
inline bool is_whole(double number) {
    constexpr double most = 2e9;
    return number == std::floor(number) && std::abs(number) <= most;
}

}  // namespace varimap
