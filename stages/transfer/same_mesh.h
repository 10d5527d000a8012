#pragma once

#include <string>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// As many vertices, and the same faces in the same order.
bool same_faces(const TriangleMesh& a, const TriangleMesh& b);
/// The same vertices in the same order, up to what files round. `a` may have no faces.
bool same_vertices(const TriangleMesh& a, const TriangleMesh& b);

/// Throws InputError where `same` does not hold of a mesh found in a file, with what may be the matter.
void require_same_mesh(bool same, const std::string& path, const TriangleMesh& found,
                       const std::string& mesh_file, const TriangleMesh& mesh);

}  // namespace varimap
