#pragma once

#include <vector>

#include "varimap/mesh/topology.h"
#include "varimap/sliding/sliding_map.h"

namespace varimap {

/// Which parts of a map are suspected.
struct StrainLimits {
    double excess = 0.25;  ///< mean excess energy (fold_energy.h) around a face of a strained part, at least
    double contrast = 3;   ///< times the median over all faces that it is at least
    double area = 2e-4;    ///< share of the source's area of the smallest part
    int most_parts = 16;   ///< the largest ones
};

/// Parts where a relaxed map is strained, as connected sets of faces, largest area first. Left out are those
/// of which more than 0.8 of the faces are `rejected`.
std::vector<std::vector<int>> strained_parts(const SlidingMap& map, const Edges& edges,
                                             const FaceData<bool>& rejected, const StrainLimits& limits);

/// The part grown ring by ring to `area`, then with all it cuts off from the largest rest.
FaceData<bool> widened(const SlidingMap& map, const Edges& edges, const std::vector<int>& part, double area);

}  // namespace varimap
