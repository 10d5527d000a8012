#pragma once

#include <vector>

#include "varimap/geodesics/geodesic_graph.h"
#include "varimap/multilevel/level_transfer.h"
#include "varimap/multilevel/matching.h"
#include "varimap/transport/alternating_minimization.h"

namespace varimap {

/// For every vertex of the mesh `from` samples: the vertex of the other mesh nearest, in the embedding, to
/// the mean image of its neighbourhood (Eq. 7). `sample_image`: the samples' mean images in the other's
/// embedding; `partner`: per sample the other side's sample near which the search begins.
std::vector<int> vertex_images(const LevelSide& from, const LevelSide& to, const RowMatrix& sample_image,
                               const std::vector<int>& partner, const GeodesicGraph& target_graph);

/// Of all vertices of both meshes, by a solution on a level.
VertexImages vertex_images(const Solution& solution, const LevelPair& pair, const PairContext& context);

}  // namespace varimap
