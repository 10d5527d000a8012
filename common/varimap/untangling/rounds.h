#pragma once

#include <array>

namespace varimap {

/// A round of relaxation and removal of folds.
struct Round {
    double regularisation;     ///< e; where it is large, folds pass through each other
    double robustness_factor;  ///< on the option
    /// Bounds the removal of folds (fold_removal.h). With four times as many 36 pairs take 8 % longer, and no
    /// fewer faces end reversed: what these do not remove is left to the repair in charts.
    double fold_visits;
    double first_inverse;  ///< share of the option's inverse_weight in the first step
    double last_inverse;   ///< the same in the last
};
/// More in the first steps would slow both directions down. Swept: 0.01 to 0.1.
constexpr double first_inverse_share = 0.03;
/// The first leaves crumpled parts to their replacement; its e swept: 0.15 to 0.6.
constexpr std::array<Round, 2> relaxation_rounds{
    {{0.3, 3, 8, first_inverse_share, first_inverse_share}, {0.1, 1, 20, first_inverse_share, 1}}};
/// The last, of an unfolded map, which settles into the other's inverse and the area bound.
constexpr Round settling_round{0.1, 1, 8, 2, 2};
constexpr int usual_fold_sweeps = 120;  ///< per patch size
/// Vertices from which on what takes more than linear time is left out, or done less often.
constexpr double large_surface = 20'000;

}  // namespace varimap
