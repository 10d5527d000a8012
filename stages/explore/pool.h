#pragma once

#include <vector>

#include "varimap/multilevel/matching.h"
#include "varimap/results/candidates.h"

namespace varimap {

/// A map to be finished, and where it comes from.
struct PooledMap {
    VertexImages images;
    Candidate origin;
};

/// The self-maps of an artifact, as images of the surface's vertices.
std::vector<VertexImages> images_of(const Candidates& self_maps, const Surface& surface);

/// Adds a map, but not one close to another that is there.
void add_if_new(std::vector<PooledMap>& pool, PooledMap map, const PairContext& context);

/// Adds the compositions of the first `count` maps with self-maps, but not those close to one that is there.
void compose(std::vector<PooledMap>& pool, int count, const std::vector<VertexImages>& self_maps_A,
             const std::vector<VertexImages>& self_maps_B, const PairContext& context);

/// Share of a surface whose vertices two maps take to places farther apart than that.
double share_elsewhere(const Points& a, const Points& b, const Surface& from, double elsewhere);

/// Share of both surfaces on which two maps differ by more than 0.15 of sqrt(area).
double difference(const VertexImages& a, const VertexImages& b, const Surface& A, const Surface& B);

VertexImages identity(const Surface& surface);

}  // namespace varimap
