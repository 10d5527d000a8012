#pragma once

#include "stages/locate/sketches.h"

namespace varimap {

/// Per vertex of the part the vertex of the whole whose distances, a row each, are most alike; differences
/// count relative to the distance.
PointMap images_alike_far(const RowMatrix& of_part, const RowMatrix& of_whole, const TriangleMesh& whole);

/// The same of distances to the landmarks, along the surfaces. `share`: of the whole's area, which the part
/// has.
PointMap images_by_landmarks(const Sketches& sketches, const Sides& sides, double share);

/// Where the vertices of the part come to lie nearest on the whole, faces looking alike, when the part is
/// moved as a rigid body to where its landmarks are nearest to their partners.
PointMap rigid_images(const Sides& sides, double share);

}  // namespace varimap
