#pragma once

#include <limits>

#include "stages/locate/params.h"
#include "stages/locate/sketches.h"

namespace varimap {

struct FoundPlacement {
    Placement placement;
    /// How much better it agrees (agreement.h) than the best one that is elsewhere; infinite where landmarks
    /// told where it is.
    double lead = std::numeric_limits<double>::infinity();
};

/// The part placed on its whole, on sketches, free at its rim (placement.h). With three landmarks or more,
/// from where it lies when it is moved as a rigid body to them, and where distances to them are alike; that
/// is all if it is hardly strained. Else also from where it fits as a rigid body (rigid_search.h). What
/// agrees best is placed again by its sounder half (anchors.h), as long as that makes it better. `share`: of
/// the whole's area, which the part has. Deterministic for any number of threads.
FoundPlacement find_placement(const Sketches& sketches, const Sides& sides, double share,
                              const LocateParams& params);

}  // namespace varimap
