#pragma once

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// Images of every vertex of two meshes, A's on faces of B and B's on faces of A.
struct MapPair {
    PointMap A_to_B, B_to_A;
};

}  // namespace varimap
