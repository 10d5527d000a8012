#pragma once

#include "varimap/geodesics/geodesic_graph.h"
#include "varimap/sliding/sliding_map.h"

namespace varimap {

/// The scale at which a continuation (continuation.h) into the open vertices ends where the target does: how
/// far the target extends beyond the image of the cut, by how far the source extends beyond the cut, between
/// 0.6 and 1.6; 1 where there is nothing to compare. The cut is what borders on the open vertices; the target
/// beyond its image is what is nearer to that than to any other image.
double continuation_scale(const SlidingMap& map, const VertexData<bool>& open,
                          const GeodesicGraph& source_graph, const GeodesicGraph& target_graph);

}  // namespace varimap
