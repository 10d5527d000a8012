#pragma once

#include "stages/locate/params.h"
#include "stages/locate/sides.h"
#include "varimap/multilevel/pair_context.h"

namespace varimap {

/// The part placed on its whole, on sketches: of several tries that with the least strain. Each places the
/// part, free at its rim (placement.h), from other images: where it lies as a rigid body, where distances to
/// the landmarks are alike, and those of plans that leave the rest of the whole out (PartSide,
/// alternating_minimization.h), with other weights of the descriptors each. Distances to landmarks, of which
/// descriptors are made, are in units of either mesh. `share`: of the whole's area, which the part has.
Placement find_placement(const PairContext& sketches, const Sides& sides, double share,
                         const LocateParams& params);

}  // namespace varimap
