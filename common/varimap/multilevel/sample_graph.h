#pragma once

#include "varimap/mesh/geodesic_graph.h"
#include "varimap/spectral/hierarchy.h"

namespace varimap {

/// A coarse graph for long shortest paths, with the mesh's vertex numbers: samples of a level are joined to
/// their neighbours and to the samples of adjacent cells by edges as long as the geodesics between them;
/// every other vertex has one edge, to the sample of its cell. Distances from any vertex to the samples
/// exceed those of `graph` by little, and take as long as there are samples, not vertices.
GeodesicGraph sample_graph(const Level& level, const GeodesicGraph& graph);

}  // namespace varimap
