#pragma once

#include "stages/refine/params.h"
#include "varimap/multilevel/pair_context.h"
#include "varimap/results/diffusion.h"
#include "varimap/results/plan.h"

namespace varimap {

/// Euclidean levels of Alg. 5 (Sec. 4.5), from the plan of the last diffusion level down to every vertex of
/// the preprocessed surfaces. Neighbourhoods are measured along the surface and costs in a mixed metric,
/// because balls and averages in R^3 bridge nearby limbs. Throws ArtifactError if the diffusion is of no
/// level of the pair, ConvergenceError if a centre is not finite.
Plan refine(const PairContext& context, const Diffusion& diffusion, const RefineParams& params);

}  // namespace varimap
