#pragma once

#include <vector>

#include "varimap/mesh/ray_mesh.h"

namespace varimap {

/// Per vertex: how much of the hemisphere above it is open, from 0 to 1, weighted by the cosine; what is
/// further away than `reach` does not count. `normals` are unit vectors, or zero. Deterministic.
std::vector<double> ambient_openness(const TriangleMesh& mesh, const Points& normals, const RayMesh& rays,
                                     double reach);

}  // namespace varimap
