#pragma once

#include "stages/explore/exploration.h"
#include "varimap/results/candidates.h"

namespace varimap {

/// Explores, sums the plans over the cells of a coarse level: coarse enough that varimap-diffuse can relax
/// marginals from there on.
Candidates explore(const PairContext& context, const ExplorationOptions& options,
                   const AlternationOptions& alternation, const IroningOptions& ironing);

}  // namespace varimap
