#pragma once

#include <functional>

#include "stages/explore/params.h"
#include "stages/explore/self_maps.h"
#include "varimap/results/candidates.h"

namespace varimap {

/// What is asked for only where it is needed; each may be empty.
struct OnDemand {
    SelfMapsOnDemand self_maps;
    std::function<PairContext()> surfaces;  ///< what was sketched, with the same landmarks
};

/// Maps worth continuing, the best first; none where landmarks decide (few_landmarks). What exploration finds
/// is composed with self-maps of both surfaces (if they are nearly isometric, of one), so that a wrong map
/// brings the right one with it, unless one is beyond doubt without that. All are finished at the resolution
/// of these surfaces (meant to be sketches), and compared as finished maps (candidate.h). Where the choice is
/// not sure, those that may be right are solved for on the surfaces that were sketched, and one that is
/// clearly better there takes the first place. Throws ConvergenceError where no map is found.
Candidates explore(const PairContext& context, const ExploreParams& params, const OnDemand& ask = {});

}  // namespace varimap
