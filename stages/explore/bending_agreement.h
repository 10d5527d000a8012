#pragma once

#include "varimap/multilevel/orientation.h"
#include "varimap/multilevel/pair_context.h"

namespace varimap {

/// Correlation over the samples of both sides of the bending there with that at their images, in [-1, 1];
/// extremes are clipped, so that postures count little.
double bending_agreement(const LevelPair& pair, const Eigen::VectorXd& bending_A,
                         const Eigen::VectorXd& bending_B, const PairOrientation& map);

}  // namespace varimap
