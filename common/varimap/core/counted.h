#pragma once

#include <string>

namespace varimap {

/// "1 face", "2 faces": a count and what is counted.
inline std::string counted(long long count, const char* one, const char* several) {
    return std::to_string(count) + " " + (count == 1 ? one : several);
}

}  // namespace varimap
