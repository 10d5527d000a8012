#pragma once

#include "stages/locate/sketches.h"
#include "varimap/quality/patch_alignment.h"

namespace varimap {

/// How well a placed part agrees with where it lies: that tells a chest from a back, which strain does not.
/// Keeps references to the sketches and to the sides.
class PlacementAgreement {
  public:
    /// `share`: of the whole's area, which the part has.
    PlacementAgreement(const Sketches& sketches, const Sides& sides, double share);

    /// 0.5 relief + 2 alignment - 0.3 min(strain, 1), the more the better: of the correlation of reliefs, of
    /// how well patches can be laid onto their images (patch_alignment.h), and of the strain.
    double operator()(const Placement& placement) const;

  private:
    const TriangleMesh& whole_;
    Points whole_normals_;
    bool opposed_;
    PatchAlignment patches_;
};

}  // namespace varimap
