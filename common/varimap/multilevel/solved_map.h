#pragma once

#include "varimap/multilevel/level_transfer.h"
#include "varimap/multilevel/pair_context.h"
#include "varimap/results/map_pair.h"
#include "varimap/transport/alternating_minimization.h"

namespace varimap {

/// What a solution on the last Euclidean level, that of every vertex in space, says of both meshes' vertices
/// (read_out.h).
MapPair solved_map(const Solution& solution, const LevelPair& level, const PairContext& context,
                   double area_bound);

}  // namespace varimap
