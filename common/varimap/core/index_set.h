#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "varimap/core/error.h"

namespace varimap {

/// 0, 1, ..., count - 1.
inline std::vector<int> all_indices(std::ptrdiff_t count) {
    std::vector<int> indices(static_cast<std::size_t>(count));
    std::iota(indices.begin(), indices.end(), 0);
    return indices;
}

/// A number of entries as the type of their indices. Throws Error (input_output): "WHAT: more than ...".
inline int entry_count(std::size_t count, const char* what) {
    if (count > std::size_t(std::numeric_limits<int>::max()))
        throw IoError(std::string(what) + ": more than 2147483647 entries; coarsen the surfaces");
    return int(count);
}

/// Sorts, and leaves each value once.
template <class Value>
void make_set(std::vector<Value>& values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace varimap
