#pragma once

#include <vector>

#include "varimap/mesh/geodesic_graph.h"
#include "varimap/multilevel/level_transfer.h"

namespace varimap {

/// For every vertex of the mesh `from` samples: the vertex of the other mesh nearest, in the embedding, to
/// the mean image of its neighbourhood (Eq. 7). `sample_image`: the samples' mean images in the other's
/// embedding; `plan`: samples of `from` x samples of `to`.
std::vector<int> vertex_images(const LevelSide& from, const LevelSide& to, const RowMatrix& sample_image,
                               const SparseMatrix& plan, const GeodesicGraph& target_graph);

}  // namespace varimap
