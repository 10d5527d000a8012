#pragma once

#include <vector>

#include "varimap/relaxation/soft_constraints.h"

namespace varimap {

/// Vertices that local sweeps may move, ascending: those of a face that holds a landmark would leave it.
std::vector<int> free_vertices(const SlidingMap& map, VertexData<bool> fixed,
                               const std::vector<SoftConstraint>& landmarks);

/// The fixed vertices, and those that hold a landmark in place, unless their triangle is reversed.
VertexData<bool> held_vertices(const SlidingMap& map, VertexData<bool> fixed,
                               const std::vector<SoftConstraint>& landmarks);

/// The marked vertices, and those on the mesh's boundary.
VertexData<bool> with_boundary(VertexData<bool> marks, const TriangleMesh& mesh);

}  // namespace varimap
