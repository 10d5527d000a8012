#pragma once

#include <utility>
#include <vector>

#include "varimap/multilevel/pair_context.h"

namespace varimap {

/// Pairs of landmarks (by number, from 0) whose partners may have been exchanged, as left and right: each
/// landmark is in one pair at most.
using Exchange = std::vector<std::pair<int, int>>;

/// Of all exchanges the one after which distances between the landmarks of both surfaces agree best, mean
/// |log| of their ratios; none where they agree by much less than as they are. Only the ends of limbs that
/// are alike can be exchanged so. All exchanges of ten landmarks are 9495; of more than that none is tried.
/// `scale`: what lengths of A's mesh are multiplied with to be those of B's.
Exchange likely_exchange(const PairContext& context, double scale = 1);

/// Whether distances between other landmarks agree far better than between those of the context: a mean
/// |log| of less than half. Four to a hundred landmarks tell.
bool distances_fit(const PairContext& context, const VertexPairs<MeshVertex>& other);

/// The landmarks with these partners exchanged.
VertexPairs<MeshVertex> exchanged(VertexPairs<MeshVertex> landmarks, const Exchange& exchange);

}  // namespace varimap
