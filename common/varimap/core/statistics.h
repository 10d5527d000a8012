#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "varimap/core/linear_algebra.h"

namespace varimap {

/// sum_k m_k |x_k - mean|^2 of the rows of a matrix, weighted by masses of sum 1.
inline double variance(const RowMatrix& points, const Eigen::VectorXd& mass) {
    const Eigen::RowVectorXd mean = mass.transpose() * points;
    return mass.dot(Eigen::VectorXd((points.rowwise() - mean).rowwise().squaredNorm()));
}

/// Weights need not sum to 1; 0 where one of the two does not vary.
inline double correlation(const Eigen::VectorXd& a, const Eigen::VectorXd& b, const Eigen::VectorXd& weight) {
    const double total = weight.sum();
    const Eigen::ArrayXd x = a.array() - weight.dot(a) / total, y = b.array() - weight.dot(b) / total;
    const double product = (weight.array() * x * y).sum();
    const double scale = std::sqrt((weight.array() * x * x).sum() * (weight.array() * y * y).sum());
    return scale > 0 ? product / scale : 0;
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
