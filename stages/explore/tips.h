#pragma once

#include <vector>

#include "varimap/geodesics/geodesic_graph.h"
#include "varimap/multilevel/matching.h"

namespace varimap {

/// Ends of limbs of one surface: where the mean distance along the surface from everywhere is largest around.
struct Tips {
    std::vector<int> vertices;  ///< the most prominent first
    RowMatrix distance;         ///< all vertices x tips, along the surface
};
/// At most `most` of them. `sources` are spread over the surface: distances from them make the mean.
Tips find_tips(const GeodesicGraph& graph, const std::vector<int>& sources, int most);

/// Tips of one surface with tips of the other (indices of both).
using TipMatching = std::vector<std::pair<int, int>>;
/// The `count` matchings that change distances between tips least, by ratio, the best first. Some tips may
/// stay without a partner, at a price.
std::vector<TipMatching> match_tips(const Tips& A, const Tips& B, int count);

/// Samples that are alike far from their matched tips.
Matching matching_by_tips(const Tips& A, const Tips& B, const TipMatching& tips, const LevelPair& pair);

}  // namespace varimap
