#pragma once

#include <string>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

// Refusals, as one line that names the defect, how many there are and the first element (0-based). Throw
// InputError.

/// No faces, faces that name a vertex there is none of. Read meshes have passed it; all else presupposes it.
void require_corners(const TriangleMesh& mesh, const std::string& path);
/// These, faces with corners that are not finite, faces that name a vertex twice.
void require_plain_faces(const TriangleMesh& mesh, const std::string& path);
/// Zero area, sizes outside 1e-50 to 1e50. Corners must be finite.
void require_size(const TriangleMesh& mesh, const std::string& path);
/// All of these, edges of three or more faces, inconsistent or non-orientable faces, vertices whose faces do
/// not form one fan.
void require_sheets(const TriangleMesh& mesh, const std::string& path);
/// Several components.
void require_connected(const TriangleMesh& mesh, const std::string& path);
/// All of these.
void require_manifold(const TriangleMesh& mesh, const std::string& path);

}  // namespace varimap
