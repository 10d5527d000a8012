#pragma once

#include <algorithm>
#include <vector>

#include "varimap/core/linear_algebra.h"

namespace varimap {

/// sum_k m_k |x_k - mean|^2 of the rows of a matrix, weighted by masses of sum 1.
inline double variance(const RowMatrix& points, const Eigen::VectorXd& mass) {
    const Eigen::RowVectorXd mean = mass.transpose() * points;
    return mass.dot(Eigen::VectorXd((points.rowwise() - mean).rowwise().squaredNorm()));
}

/// The middle of an odd number of values, the upper one of the two in the middle of an even one.
inline double upper_median(Eigen::VectorXd values) {
    const auto middle = values.begin() + values.size() / 2;
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The middle of an odd number of values, the mean of the two in the middle of an even one.
inline double mean_median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return (values[(n - 1) / 2] + values[n / 2]) / 2;
}

}  // namespace varimap
