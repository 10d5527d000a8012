#pragma once

#include <string>
#include <vector>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// Surfaces of a collection, known by the same samples in all maps: positions in units of sqrt(area).
using Samples = std::vector<Points>;

/// One of the maps found for a pair: per sample of the one surface the nearest sample of the other.
struct SampledMap {
    std::vector<int> there, back;
    double score = 0;  ///< candidate.h: less is better, .01 is about 1% of energy
};

/// A pair of surfaces and the maps found for it, the best first; at least one.
struct PairOfMaps {
    int source = 0, target = 0;
    std::vector<SampledMap> maps;
    double trust = 0;  ///< probability that the first is right
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

/// The choice under which loops of three pairs close best. It minimises the sum over the pairs of
///   min(score - first score, 0.2) / 0.2 + 2 * mean over the loops of min(error, 0.2) / 0.2
/// by coordinate descent from two starts: the first map of every pair; and the maps nearest to compositions
/// along a spanning tree of the most trusted pairs. The first maps are kept where nothing is better.
Choice choose(const Samples& samples, const std::vector<PairOfMaps>& pairs);

}  // namespace varimap
