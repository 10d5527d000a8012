#pragma once

#include <cstddef>
#include <vector>

#include "stages/explore/finished_pool.h"
#include "varimap/results/candidates.h"

namespace varimap {

/// Of the ends of limbs of A that on whose images the first `count` maps differ most: where the first map
/// takes it farthest away, along B, from where the nearest of the others does; of all vertices if ends of
/// limbs are much the same in two of the maps. A landmark there decides among them. Not for fewer than two
/// maps.
TellingVertex telling_vertex(const std::vector<Appraised>& list, std::size_t count,
                             const PairContext& context);

}  // namespace varimap
