#pragma once

#include "stages/locate/params.h"
#include "stages/locate/sides.h"
#include "varimap/multilevel/pair_context.h"

namespace varimap {

/// The part placed on its whole, on sketches: the best of several tries, which begin alike, from distances to
/// the landmarks, and weigh descriptors differently. Each solves for a plan that leaves the rest of the whole
/// out (Part, alternating_minimization.h), and places the part, free at its rim, from there (placed_part.h).
/// A wrong or folded start ends with more strain. `share`: of the whole's area, which the part has.
PlacedPart find_place(const PairContext& sketches, const Sides& sides, double share,
                      const LocateParams& params);

}  // namespace varimap
