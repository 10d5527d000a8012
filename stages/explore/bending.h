#pragma once

#include "common/mapping/orientation.h"
#include "common/mapping/pair_context.h"

namespace varimap {

/// How far each vertex stands out of the smoothed surface, along the outward normal, units of sqrt(area): the
/// surface less its heat flow (by the eigenbasis) at a small time. Positive on ridges, negative in hollows.
/// Isometries do not keep it, so it tells a toe from a heel where distances along the surface nearly cannot.
Eigen::VectorXd bending(const SurfaceData& data);

/// Correlation over the samples of both sides of the bending there with that at their images, in [-1, 1];
/// extremes are clipped, so that postures count little.
double bending_agreement(const LevelPair& pair, const Eigen::VectorXd& bending_A, const Eigen::VectorXd& bending_B,
                         const Orientation& A_to_B, const Orientation& B_to_A);

}  // namespace varimap
