#pragma once

#include <vector>

#include "stages/explore/finished_pool.h"
#include "varimap/results/candidates.h"

namespace varimap {

// Maps of sketches as the artifact holds them.

/// Where the vertices of both meshes lie on the input meshes, and where they go there.
Correspondences correspondences(const MapPair& maps, const Surface& A, const Surface& B);

/// These maps, in their order, and what is known of them.
Candidates candidates_of(const std::vector<Appraised>& list, const PairContext& context);

/// The same, with previews of the first three where the choice among them is not sure.
Candidates with_previews(const std::vector<Appraised>& list, const PairContext& context);

}  // namespace varimap
