#pragma once

#include "common/mapping/pair_context.h"
#include "common/mapping/plan.h"
#include "stages/diffuse/params.h"

namespace varimap {

/// Diffusion levels of Alg. 5: the coarsest level in full, then level by level down to the last one at which
/// diffusion distances discern. `position_A/B` of the result are the vertices whose diffusion coordinates are
/// nearest to the centres.
Plan diffuse(const PairContext& context, const DiffuseParams& params);

}  // namespace varimap
