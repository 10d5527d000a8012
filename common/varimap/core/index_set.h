#pragma once

#include <algorithm>
#include <vector>

namespace varimap {

/// Sorts, and leaves each value once.
inline void make_set(std::vector<int>& values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace varimap
