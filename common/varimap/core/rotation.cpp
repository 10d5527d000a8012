#include "varimap/core/rotation.h"

#include <Eigen/LU>
#include <Eigen/SVD>

namespace varimap {

Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& M, bool mirrored) {
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const bool reflects = svd.matrixU().determinant() * svd.matrixV().determinant() < 0;
    const Eigen::Vector3d sign(1, 1, reflects != mirrored ? -1 : 1);
    return svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
}

}  // namespace varimap
