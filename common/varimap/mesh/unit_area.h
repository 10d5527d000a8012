#pragma once

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// The mesh moved and scaled to unit area, its bounding box centred at the origin.
TriangleMesh unit_area(const TriangleMesh& mesh);

/// Whether a triangle of such a mesh has no area beyond rounding: twice its area is at most 1e-10 of its
/// longest edge squared (or the edge is no longer than rounding leaves it; coordinates are of order 1).
bool is_degenerate(const TriangleMesh& mesh, int f);

}  // namespace varimap
