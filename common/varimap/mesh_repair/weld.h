#pragma once

#include <vector>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// Per vertex, the lowest vertex of those that are one with it; others stand for themselves. One are, and
/// whoever is one with those:
///   copies: vertices in the same place of components each of whose faces lies in the place of a face of
///   another component, as the back of what was given both sides
///   boundary vertices (of edges with one face) in the same place, and then those within `tolerance` of each
///   other; for 0, within a hundredth of all boundary edges at both: what single precision or few digits make
///   of the same place, and shorter than anything that the mesh shows
/// Faces must not name a vertex twice, their corners are finite. O(n log n).
std::vector<int> welded_vertices(const TriangleMesh& mesh, double tolerance);

}  // namespace varimap
