#pragma once

#include <utility>
#include <vector>

#include "varimap/multilevel/pair_context.h"
#include "varimap/results/correspondences.h"

namespace varimap {

/// Samples of one level matched with each other (index on A, index on B); every sample occurs.
using Matching = std::vector<std::pair<int, int>>;

/// Centres at the mean of the matched samples, smoothed by W.
Centres centres_of(const LevelPair& pair, const Matching& matching);

/// Images, vertices of the other mesh, of every vertex.
struct VertexImages {
    std::vector<int> A_to_B, B_to_A;
};
/// Each sample with that in whose cell its image lies.
Matching matching_of(const VertexImages& images, const LevelPair& pair);

/// The first diffusion level with enough samples to hold on to a map from elsewhere, or the last.
int first_level_for_a_map(const PairContext& context);
/// The vertices at the ends of correspondences, corners of the faces they lie on.
struct VertexCorrespondences {
    std::vector<std::pair<int, int>> from_A, from_B;
};
VertexCorrespondences at_vertices(const Correspondences& map, const Surface& A, const Surface& B);
/// Each sample with that in whose cell the nearest correspondence ends, nearest in the level's embedding.
Matching matching_of(const VertexCorrespondences& map, const LevelPair& pair);

}  // namespace varimap
