#include "varimap/core/rotation.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <numbers>

namespace varimap {

Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& M, bool mirrored) {
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const bool reflects = svd.matrixU().determinant() * svd.matrixV().determinant() < 0;
    const Eigen::Vector3d sign(1, 1, reflects != mirrored ? -1 : 1);
    return svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
}

Eigen::Matrix3d nearest_rotation(const PointRows& from, const PointRows& to, const Eigen::VectorXd& weights,
                                 bool mirrored) {
    const double sum = weights.sum();
    const Eigen::RowVector3d from_mean = weights.transpose() * from / sum,
                             to_mean = weights.transpose() * to / sum;
    return nearest_rotation(
        (to.rowwise() - to_mean).transpose() * weights.asDiagonal() * (from.rowwise() - from_mean), mirrored);
}

double degrees(const Eigen::Matrix3d& rotation) {
    return Eigen::AngleAxisd(rotation).angle() * 180 / std::numbers::pi;
}

}  // namespace varimap
