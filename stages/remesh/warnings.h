#pragma once

#include "stages/remesh/map_quality.h"
#include "varimap/results/pair_record.h"

namespace varimap {

/// Warns (log.h) of what a map that is right does not have, so that one that cannot be right does not pass as
/// one. In this order:
///   pinned landmarks  that are not met, look exchanged, or around which the map is elsewhere; a list of them
///                     that looks one row off
///   initial map       from which the finished one is far (initial_map.h)
///   exploration       which was sure of its candidate and is not of the finished map
///   tears             of either direction: much is reversed, on several faces, or uncovered
///   strain            where neither tears
///   twist             of a shaft, by the direction that has more
///   components        without a partner, and those of which one looks inward, its partner outward
/// Where most of a surface's area lies on slivers, these are named as the likely cause of tears or strain.
void warn_of(const MapQuality& quality, const PairRecord& record);

}  // namespace varimap
