#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace varimap {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;

/// Row-major, so that the row of a sample or vertex is contiguous and one row's entries can be walked.
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

}  // namespace varimap
