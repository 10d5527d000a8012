#pragma once

#include <vector>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// Marks all faces but those that lie on others and are to go: of faces with the same three vertices one is
/// left, of the orientation that most have. Where as many are of either orientation they are either a sheet
/// that was given both sides, of which the first are left, or a fin: they share an edge with other faces, the
/// surface goes on without them at each such edge, and they make up at most a thousandth of the area. Of a
/// fin none is left. Faces must not name a vertex twice.
std::vector<char> without_duplicates(const TriangleMesh& mesh);

}  // namespace varimap
