#pragma once

#include "stages/locate/sides.h"
#include "varimap/mesh/closest_point.h"

namespace varimap {

/// x -> turn x + shift, of a part as large as it is on the whole.
struct Pose {
    Eigen::Matrix3d turn;
    Vec3 shift;
    double misfit = 0;

    Vec3 operator()(const Vec3& x) const { return turn * x + shift; }
};

/// A part as a rigid body beside its whole. Keeps a reference to the whole.
class RigidBody {
  public:
    /// `share`: of the whole's area, which the part has.
    RigidBody(const Sides& sides, double share);

    /// The pose that takes points of the part nearest to points of the whole, each weighted; rows belong
    /// together.
    Pose fitted(const Points& from, const Points& to, const Eigen::VectorXd& weight) const;
    /// The part's vertices at the size they have on the whole.
    const Points& points() const { return points_; }
    /// The normal of faces that a vertex should lie on.
    Vec3 normal(const Pose& pose, int v) const {
        return handedness_ * (pose.turn * normals_.row(v).transpose());
    }
    const Points& normals() const { return normals_; }
    /// -1: the surfaces are of opposite handedness, and poses are reflections.
    double handedness() const { return handedness_; }
    const ClosestPoint& closest() const { return closest_; }
    /// Where each vertex comes to lie nearest on the whole, faces looking alike.
    PointMap images(const Pose& pose) const;

  private:
    double handedness_;
    Points points_, normals_;
    ClosestPoint closest_;
};

}  // namespace varimap
