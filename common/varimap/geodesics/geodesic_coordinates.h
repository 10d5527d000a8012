#pragma once

#include "varimap/core/linear_algebra.h"
#include "varimap/geodesics/geodesic_graph.h"

namespace varimap {

/// Points whose straight distances are those along the graph, as well as `dimensions` allow: classical
/// multidimensional scaling of the distances to up to 500 points far from each other (landmark MDS; de Silva
/// and Tenenbaum 2004), columns by falling variance. Of an open curve this is its arc length, exactly. As
/// many columns as have a positive variance; the graph must be connected and have two points or more.
RowMatrix geodesic_coordinates(const GeodesicGraph& graph, int dimensions);

}  // namespace varimap
