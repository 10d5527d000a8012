#pragma once

#include <vector>

#include "varimap/sliding/face_energy.h"

namespace varimap {

/// A point of the source (not only a vertex) whose image is drawn to a place in space.
struct SoftConstraint {
    SurfacePoint from;
    Vec3 to;
    double weight;  ///< w
    double radius;  ///< c, the distance from which on the pull weakens
};

/// A data term: the sum over constraints of w rho(d), d the distance of the image of `from` (linear on its
/// face) from `to`, rho(d) = c^2 / 2 log(1 + d^2 / c^2).
double value(const SoftConstraint& constraint, const SlidingMap& map);
/// Of the face of `from`, in the frames of its corners' images; the Hessian is that of Gauss and Newton.
FaceDerivatives derivatives(const SoftConstraint& constraint, const SlidingMap& map,
                            const VertexData<TangentFrame>& frames);

/// Landmarks that are points, as constraints: the image of each first point, on the source, goes to the
/// second, on the target. Measured: off by at most 0.001 of sqrt(area), at the tip of a horn by 0.007.
std::vector<SoftConstraint> landmark_constraints(const SlidingMap& map, const PointPairs& landmarks);

/// Of constraints by the inverse, in sqrt(area). Swept: to 0.1; at 0.025 the mean round trip is 0.00183.
constexpr double inverse_radius = 0.05;
/// What makes a map the inverse of `back`, from its target to its source: every vertex b of the target, of
/// area n_b, draws the image of back(b) to itself with the weight n_b * weight. An isometry's energy alone
/// lets images shrink from the ends of limbs; this holds them there, since the other direction has to put the
/// end of its limb somewhere.
std::vector<SoftConstraint> inverse_constraints(const SlidingMap& map, const PointMap& back, double weight);

}  // namespace varimap
