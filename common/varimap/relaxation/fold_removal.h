#pragma once

#include "varimap/sliding/sliding_map.h"

namespace varimap {

/// Removes reversed and collapsed faces (D <= flat_limit) by local relaxation in growing patches around them,
/// with the regularisation of Garanzha et al. (2021), which falls as the worst face rises. Every connected
/// patch has a schedule of its own, so that folds which cannot be slid away (around a branch point) do not
/// keep the others waiting, and passes over vertices around which nothing moves. What lies outside the
/// patches, and vertices with fixed[v], stay where they are.
struct FoldRemoval {
    /// Least signed area ratio aimed at. Swept: to 0.03; at 0.003 a branch point is left.
    static constexpr double flat_limit = 0.01;
    int most_sweeps = 300;  ///< per patch size
    /// Of all vertices in the mean, over all patches: bounds the time. Those passed over count, too.
    double most_visits = 150;
    int strikes = 8;  ///< tries in a row without fewer folds after which a patch is left as it is

    /// Returns the number of sweeps done, over all patches; 0 where nothing is folded.
    int operator()(SlidingMap& map, const VertexData<bool>& fixed) const;
};

}  // namespace varimap
