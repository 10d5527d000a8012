#pragma once

#include <string>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// One direction of a map as an .npz: `face` (int32), `barycentric` (n x 3), `nearest_vertex` (int32; -1 as
/// of faces), and `format`, `shape`, `data`, `indices`, `indptr` of the sparse matrix (CSR, as SciPy's
/// load_npz reads it) that takes values of the vertices of `target` to the images; rows without an image are
/// empty.
std::string to_npz(const PointMap& map, const TriangleMesh& target);

}  // namespace varimap
