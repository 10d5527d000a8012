#pragma once

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// A map between two surfaces, rough or fine, as points of their INPUT meshes that go to each other: spread
/// over both surfaces, so that the nearest of them tells where any other point goes. Whatever the surfaces'
/// meshes are, a map of lower or of higher resolution can begin from it.
struct Correspondences {
    PointPairs from_A;  ///< points of A, and where each goes on B
    PointPairs from_B;  ///< points of B, and where each goes on A
};

}  // namespace varimap
