#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace varimap {

/// 0, 1, ..., count - 1.
inline std::vector<int> all_indices(std::ptrdiff_t count) {
    std::vector<int> indices(static_cast<std::size_t>(count));
    std::iota(indices.begin(), indices.end(), 0);
    return indices;
}

/// Sorts, and leaves each value once.
template <class Value>
void make_set(std::vector<Value>& values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace varimap
