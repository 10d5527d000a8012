#pragma once

#include "varimap/relaxation/sliding_map.h"

namespace varimap {

/// Removes reversed and collapsed faces (D <= flat_limit) by local relaxation in growing patches around them,
/// with the regularisation of Garanzha et al. (2021), which falls as the worst face rises. What lies outside
/// the patch, and vertices with fixed[v], stay where they are.
struct FoldRemoval {
    /// Least signed area ratio aimed at. Swept: to 0.03; at 0.003 a branch point is left.
    static constexpr double flat_limit = 0.01;
    int most_sweeps = 300;     ///< per patch size
    double most_visits = 150;  ///< of all vertices in the mean, over all patch sizes: bounds the time

    /// Returns the number of sweeps done, over all patch sizes; 0 where nothing is folded.
    int operator()(SlidingMap& map, const VertexData<bool>& fixed) const;
};

}  // namespace varimap
