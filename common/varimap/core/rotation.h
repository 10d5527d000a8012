#pragma once

#include <Eigen/Core>

namespace varimap {

/// The rotation R that makes trace(R' M) largest (Kabsch 1976); of M = sum_k y_k x_k' of centred points, the
/// one for which R x_k are nearest to y_k. `mirrored`: the best reflection instead.
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& M, bool mirrored = false);

/// One point per row.
using PointRows = Eigen::Ref<const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>>;
/// The same that takes weighted points nearest to others, both about their centroids.
Eigen::Matrix3d nearest_rotation(const PointRows& from, const PointRows& to, const Eigen::VectorXd& weights,
                                 bool mirrored = false);

/// The angle of a rotation, in degrees.
double degrees(const Eigen::Matrix3d& rotation);

}  // namespace varimap
