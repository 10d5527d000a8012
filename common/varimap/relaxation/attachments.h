#pragma once

#include <Eigen/Core>
#include <vector>

#include "varimap/relaxation/moving_map.h"

namespace varimap {

/// A point of the source (not only a vertex) whose image is drawn to a place in space.
struct Attachment {
    SurfacePoint from;
    Vec3 to;
    double weight;  ///< w
    double reach;   ///< c, the distance from which on the pull weakens
};

/// A data term: the sum over attachments of w rho(d), d the distance of the image of `from` (linear on its
/// face) from `to`, rho(d) = c^2 / 2 log(1 + d^2 / c^2).
struct AttachmentSystem {
    Eigen::Matrix<double, 6, 1> gradient;
    Eigen::Matrix<double, 6, 6> hessian;  ///< Gauss-Newton
};
double value(const Attachment& attachment, const MovingMap& map);
/// By the coordinates of the images of the corners of the face of `from` in their frames.
AttachmentSystem derivatives(const Attachment& attachment, const MovingMap& map,
                             const std::vector<Eigen::Matrix<double, 3, 2>>& frames);

/// Landmarks that are points, as attachments: the image of each first point, on the source, goes to the
/// second, on the target. Measured: off by at most 0.001 of sqrt(area), at the tip of a horn by 0.007.
std::vector<Attachment> landmark_attachments(const MovingMap& map, const PointPairs& landmarks);

/// What makes a map the inverse of `back`, from its target to its source: every vertex b of the target, of
/// area n_b, attaches back(b) to itself with the weight n_b * weight. An isometry's energy alone lets images
/// shrink from the ends of limbs; this holds them there, since the other direction has to put the end of its
/// limb somewhere.
constexpr double inverse_reach = 0.05;  ///< in sqrt(area)
std::vector<Attachment> inverse_attachments(const MovingMap& map, const PointMap& back, double weight);

}  // namespace varimap
