#pragma once

#include "varimap/core/linear_algebra.h"

namespace varimap {

/// sum_k m_k |x_k - mean|^2 of the rows of a matrix, weighted by masses of sum 1.
inline double variance(const RowMatrix& points, const Eigen::VectorXd& mass) {
    const Eigen::RowVectorXd mean = mass.transpose() * points;
    return mass.dot(Eigen::VectorXd((points.rowwise() - mean).rowwise().squaredNorm()));
}

}  // namespace varimap
