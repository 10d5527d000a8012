#pragma once

#include "stages/locate/sides.h"
#include "varimap/multilevel/matching.h"

namespace varimap {

/// How far all vertices of both meshes are from the landmarks, along the surfaces, in units of the whole's
/// mesh.
class LandmarkDistances {
  public:
    /// `share`: of the whole's area, which the part has.
    LandmarkDistances(const Sides& sides, double share);

    /// Samples of each side with those of the other that are alike far from the landmarks.
    Matching matching(const LevelPair& pair, PartSide which) const;
    /// Per vertex of the part the vertex of the whole that is alike far.
    PointMap images(const TriangleMesh& whole) const;

  private:
    RowMatrix part_, whole_;  ///< vertices x landmarks
};

/// Where the vertices of the part come to lie nearest on the whole, faces looking alike, when the part is
/// moved as a rigid body to where its landmarks are nearest to their partners.
PointMap rigid_images(const Sides& sides, double share);

}  // namespace varimap
