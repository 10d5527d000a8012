#pragma once

#include <vector>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// Per vertex, the lowest vertex of those that are one with it: vertices on the boundary (edges of one face)
/// within `tolerance` of each other, or in the same place for 0, and whoever is one with those. Others stand
/// for themselves. Faces must not name a vertex twice, their corners are finite. O(n log n).
std::vector<int> weld_boundaries(const TriangleMesh& mesh, double tolerance);

}  // namespace varimap
