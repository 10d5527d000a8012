#pragma once

#include <vector>

#include "stages/locate/sketches.h"

namespace varimap {

/// Where a part may lie when no landmarks tell: images of its vertices as it is laid on the whole as a rigid
/// body, in places that differ, the best fitting first. Limbs may bend and proportions differ as long as
/// some of the part fits where it belongs; placing and rating what comes of it (placement.h, agreement.h)
/// tell the right one. A few vertices far from the part's rim are laid on places all over the whole, normal
/// on normal, in turns by 30 degrees; the better poses slide to where more fits (iterated closest points).
/// The misfit of a pose is the mean over some of the part's vertices of
///     1 - exp(-d^2 / t^2) max(n . m, 0)
/// with the distance d to the closest point of the whole, the normals n and m, and the tolerance t in units
/// of the part. `share`: of the whole's area, which the part has. Deterministic for any number of threads.
std::vector<PointMap> rigid_guesses(const Sketches& sketches, const Sides& sides, double share);

}  // namespace varimap
