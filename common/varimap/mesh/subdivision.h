#pragma once

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// A mesh whose faces are cut into four at the midpoints of their edges.
struct Subdivision {
    TriangleMesh mesh;   ///< the vertices before, then the midpoints; face f became 4 f to 4 f + 3
    PointMap midpoints;  ///< where they lie on the mesh before
};
/// Any mesh whose faces do not repeat a vertex.
Subdivision subdivide(const TriangleMesh& mesh);

/// Where a point of a mesh lies on its subdivision.
SurfacePoint on_subdivision(const SurfacePoint& point);

}  // namespace varimap
