#pragma once

#include <algorithm>
#include <vector>

#include "varimap/core/index_set.h"

namespace varimap {

/// Sets of numbers that are joined; each is named by its lowest, whatever the order of the joins.
class DisjointSets {
  public:
    explicit DisjointSets(int count) : parent_(all_indices(count)) {}
    /// Halves the path on the way.
    int lowest(int i) {
        while (parent_[std::size_t(i)] != i)
            i = parent_[std::size_t(i)] = parent_[std::size_t(parent_[std::size_t(i)])];
        return i;
    }
    void join(int a, int b) {
        a = lowest(a);
        b = lowest(b);
        parent_[std::size_t(std::max(a, b))] = std::min(a, b);
    }

  private:
    std::vector<int> parent_;
};

}  // namespace varimap
