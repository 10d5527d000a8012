#include "stages/locate/rigid_body.h"

#include <cmath>

#include "varimap/core/rotation.h"

namespace varimap {

RigidBody::RigidBody(const Sides& sides, double share)
    : handedness_(sides.handedness.are_opposite() ? -1 : 1),
      points_(std::sqrt(share) * sides.part.mesh.vertices),
      normals_(vertex_normals(sides.part.mesh)),
      closest_(sides.whole.mesh) {}

Pose RigidBody::fitted(const Points& from, const Points& to, const Eigen::VectorXd& weight) const {
    const double sum = weight.sum();
    const Eigen::RowVector3d from_mean = weight.transpose() * from / sum,
                             to_mean = weight.transpose() * to / sum;
    const Eigen::Matrix3d turn = nearest_rotation(from, to, weight, handedness_ < 0);
    return {turn, (to_mean - from_mean * turn.transpose()).transpose()};
}

PointMap RigidBody::images(const Pose& pose) const {
    PointMap images;
    for (int v = 0; v < int(points_.rows()); ++v)
        images.push_back(closest_(pose(points_.row(v).transpose()), normal(pose, v)).point);
    return images;
}

}  // namespace varimap
