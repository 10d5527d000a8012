#pragma once

#include <vector>

#include "stages/explore/params.h"
#include "varimap/multilevel/matching.h"
#include "varimap/results/candidate.h"
#include "varimap/results/map_pair.h"

namespace varimap {

/// A map to be finished, and where it comes from.
struct PooledMap {
    VertexImages images;
    Candidate origin;
};

/// Keeps a reference.
MapStart start_of(const PooledMap& map);

/// What one exploration finds on the levels too coarse to see orientation (Exploration::coarse_levels).
ExplorationProgress coarsely_explored(const PairContext& context, const ExplorationOptions& options,
                                      const ExploreParams& params);

/// What one exploration finds, from there (with the same options) or from the beginning on, numbered from 1;
/// mirrored maps only where there are no others.
std::vector<PooledMap> explored(const PairContext& context, const ExplorationProgress& coarse,
                                const ExplorationOptions& options, const ExploreParams& params);
std::vector<PooledMap> explored(const PairContext& context, const ExplorationOptions& options,
                                const ExploreParams& params);

/// Maps from principal axes alone, `count` at most.
std::vector<PooledMap> from_axes(const PairContext& context, int count, const ExploreParams& params);

/// The map that landmarks lead to; none without landmarks.
std::vector<PooledMap> led_by_landmarks(const PairContext& context, const ExploreParams& params);

/// `led`, if there is such a map, and those that explorations found, numbered through.
std::vector<PooledMap> pooled(std::vector<PooledMap> led,
                              const std::vector<std::vector<PooledMap>>& explorations,
                              const PairContext& context);

/// The vertices nearest to the images.
VertexImages vertex_images(const MapPair& maps, const PairContext& context);

/// Adds a map, but not one close to another that is there.
void add_if_new(std::vector<PooledMap>& pool, PooledMap map, const PairContext& context);

}  // namespace varimap
