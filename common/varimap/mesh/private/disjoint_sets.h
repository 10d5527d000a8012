#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

namespace varimap {

/// Sets of numbers that are joined; each is named by its lowest, whatever the order of the joins.
class DisjointSets {
  public:
    explicit DisjointSets(int count) : parent_(std::size_t(count)) {
        std::iota(parent_.begin(), parent_.end(), 0);
    }
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
