#pragma once

#include <vector>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// A bisected mesh and the way back to the mesh it was made from.
struct Bisection {
    TriangleMesh mesh;                    ///< the vertices before, in their order, then one per split
    std::vector<int> origin;              ///< per face: the face it lies in before
    std::vector<SurfacePoint> on_origin;  ///< per vertex: where it lies before; dyadic coordinates, exact;
                                          ///< between two faces, on the lower; nowhere if no face uses it
    double longest_left = 0;              ///< above the target where `max_vertices` ended it; else 0
};

/// Recursive longest-edge bisection (Sec. 5, Limitations): splits the longest edge of all at its midpoint,
/// with both faces beside it, until no edge exceeds `target_length`.
///
/// Lengths count as equal within 2e-4, ties go to the edge with the longer surroundings, then to the lower
/// vertices, so that rounding (a turned or moved copy) does not change the connectivity. O(n log n).
/// The mesh must be manifold. Ends early, with its longest edges split, where the target needs more than
/// `max_vertices`.
Bisection bisect_longest_edges(const TriangleMesh& mesh, double target_length, int max_vertices);

}  // namespace varimap
