#pragma once

#include <vector>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// Surfaces of a collection, known by the same samples in all maps: positions in units of sqrt(area).
using Samples = std::vector<Points>;

/// One of the maps found for a pair: per sample of the one surface the nearest sample of the other.
struct SampledMap {
    std::vector<int> there, back;
    double probability = 0;  ///< that this one is right, as far as the pair alone tells
};

/// A pair of surfaces and the maps found for it, the best first; at least one. What is missing to one of the
/// sum of their probabilities is that of none of them being right.
struct PairOfMaps {
    int source = 0, target = 0;
    std::vector<SampledMap> maps;
    bool sure =
        false;  ///< of the first map, which stays unless many ways over third surfaces speak against it
};

/// A choice among the maps of every pair, by number from 0.
using Choice = std::vector<int>;

/// How well loops close for one pair under a choice: ways over a third surface, compared with the pair's map.
struct Loops {
    int count = 0, closed = 0;  ///< closed: off by less than `closing` in the mean
    double error = 0;           ///< mean over the loops of the mean distance, units of sqrt(area)
};
inline constexpr double closing = .1;

std::vector<Loops> measure_loops(const Samples& samples, const std::vector<PairOfMaps>& pairs,
                                 const Choice& choice);

/// Per map, the first whose images are hardly elsewhere (less than `closing` in the mean): by another way the
/// same was found. target: its samples.
std::vector<std::size_t> kinds(const std::vector<SampledMap>& maps, const Points& target);

/// Synchronisation of the collection: every surface has one map to a common root, so that all loops close,
/// and of all such ways of laying the collection out, the most probable is looked for. If d_k is the mean
/// distance (units of sqrt(area)) between what the layout says of a pair and the pair's k-th map, which is
/// right with probability p_k, the layout's log-probability is the sum over the pairs of
///   log(sum_k p_k exp(-(d_k / 0.1)^2) + 0.05 (1 - sum_k p_k)).
/// A pair takes the map whose term is largest, unless the layout is nearly as probable (log, 4) with one of
/// the pair's surfaces laid out over the pair's first map instead. If the last term is the largest, what the
/// layout says of the pair is added to its maps, with probability 0, and taken where ways over third surfaces
/// that agree with it are right more often, in the mean, than the first map is. A pair that is sure keeps its
/// first map unless two such ways or more, in the mean, are right.
Choice choose(const Samples& samples, std::vector<PairOfMaps>& pairs);

}  // namespace varimap
