#include "varimap/artifact/consistency.h"

#include <algorithm>
#include <cmath>

namespace varimap {

bool are_in_range(const std::vector<int>& indices, Eigen::Index count, int least) {
    return std::all_of(indices.begin(), indices.end(), [&](int i) { return i >= least && i < count; });
}

bool are_distinct_in_range(const std::vector<int>& indices, Eigen::Index count) {
    std::vector<int> sorted = indices;
    std::sort(sorted.begin(), sorted.end());
    return are_in_range(indices, count) && std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
}

bool are_masses(const Eigen::VectorXd& mass) {
    constexpr double rounding = 1e-6;  // of a sum over a million
    return mass.size() > 0 && mass.allFinite() && mass.minCoeff() > 0 && std::abs(mass.sum() - 1) <= rounding;
}

}  // namespace varimap
