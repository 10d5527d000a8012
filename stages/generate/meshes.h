#pragma once

#include <array>
#include <vector>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap::shapes {

/// A mesh from lists.
TriangleMesh make_mesh(const std::vector<Vec3>& points, const std::vector<std::array<int, 3>>& faces);

/// The same surface with vertices and faces in another order. old_vertex[new] names the vertex it was.
TriangleMesh shuffled(const TriangleMesh& mesh, unsigned seed, std::vector<int>* old_vertex = nullptr);

/// x -> scale * R x + offset, R a turn by `angle` about a skew axis.
TriangleMesh moved(TriangleMesh mesh, double scale, double angle, const Vec3& offset);

}  // namespace varimap::shapes
