#pragma once

#include "stages/locate/sketches.h"

namespace varimap {

/// Images of the part's vertices, on vertices of the whole, that agree with the half of a placement that
/// changes lengths least: alike far, along the surfaces, from a few vertices of that half. What was strained
/// there, an arm on the wrong side, a part folded over, comes to lie by what was not. `share`: of the whole's
/// area, which the part has.
PointMap images_by_anchors(const PointMap& placement, const Sketches& sketches, double share);

}  // namespace varimap
