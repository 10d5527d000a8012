#pragma once

#include <vector>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// Where a map tears, as one between surfaces of different genus must (Fig. 17), and what it is like
/// elsewhere. All lengths are in units of the square root of the area of the surface they are on.
struct TearReport {
    int torn_edges = 0;            ///< stretched to more than `stretch` times their length
    double torn_area_percent = 0;  ///< of the triangles that have such an edge
    double near_area_percent = 0;  ///< of those within `distance` of such an edge, in space
    int reversed_elsewhere = 0;    ///< reversed triangles (verification.h) farther from it
    double largest_stretch = 0;    ///< of edges farther from it
    double returned_percent = 0;   ///< of the target's vertices whose image is farther from it: those that
                                   ///< come back to within `distance` through both maps, so are covered once
};

struct TearOptions {
    double stretch = 5, distance = .1;
};

/// `there` has a row per vertex of the source, on faces of the target; `back` the other way round.
TearReport find_tear(const TriangleMesh& source, const TriangleMesh& target, const PointMap& there,
                     const PointMap& back, const TearOptions& options);

}  // namespace varimap
