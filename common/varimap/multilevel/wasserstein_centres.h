#pragma once

#include "varimap/multilevel/pair_context.h"

namespace varimap {

/// Centres of the Wasserstein-2 plan between positions in space (Sec. 5, Initialization), for aligned
/// domains. Every pair of samples has an entry.
Centres wasserstein_centres(const LevelPair& pair, const PairContext& context,
                            const AlternationOptions& options);

}  // namespace varimap
