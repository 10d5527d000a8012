#pragma once

#include "varimap/core/indexed.h"
#include "varimap/surface/surface.h"

namespace varimap {

/// The faces of the whole's input that a part covers: those whose middles lie at the image of the part's
/// mesh, inside of its rim. `images`: of the vertices of the part's mesh, on the whole's.
FaceData<char> covered_faces(const PointMap& images, const TriangleMesh& part, const Surface& whole);

/// The faces of the whole's input that hold images of the part's vertices or of points along its edges, and
/// those that share a vertex with them. A strip of the part that is narrower than a face covers none.
FaceData<char> touched_faces(const PointMap& images, const TriangleMesh& part, const Surface& whole);

}  // namespace varimap
