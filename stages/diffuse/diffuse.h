#pragma once

#include <optional>

#include "stages/diffuse/params.h"
#include "varimap/multilevel/pair_context.h"
#include "varimap/results/candidates.h"
#include "varimap/results/diffusion.h"

namespace varimap {

/// Diffusion levels of Alg. 5: the coarsest level in full, then level by level down to the last one at which
/// diffusion distances discern.
/// With candidates of varimap-explore, the one chosen by the parameters is continued, on the last of these
/// levels alone. Throws UsageError if there is no such candidate. Without candidates, a map from elsewhere
/// may be continued, from the first level that has enough samples to hold on to it.
Diffusion diffuse(const PairContext& context, const DiffuseParams& params,
                  const std::optional<Candidates>& candidates = {},
                  const std::optional<Correspondences>& initial_map = {});

}  // namespace varimap
