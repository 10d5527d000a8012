#pragma once

#include <vector>

#include "varimap/multilevel/ironing.h"
#include "varimap/multilevel/matching.h"
#include "varimap/relaxation/untangling.h"
#include "varimap/transport/alternating_minimization.h"

namespace varimap {

/// A map solved for on all levels and relaxed on the meshes, which are meant to be coarse.
struct FinishedMap {
    int start = 0;      ///< which of the starts it was; of several that became the same, the first
    MapPair maps;       ///< per vertex of either mesh, on faces of the other
    double energy = 0;  ///< Eq. (3) on the last level, of every vertex
};

struct FinishingOptions {
    AlternationOptions alternation;
    IroningOptions ironing;
    double shape_weight = 0.25;  ///< of add_shape_term, as in varimap-diffuse and varimap-refine
    /// Rounds of ironing on the Euclidean levels, where mirrored limbs are placed anew in any case: left as
    /// they are, they make the right map look worse than a wrong one.
    int euclidean_rounds = 3;
    int most = 4;            ///< maps that reach the last level: those of least energy
    double worst = 1.6;      ///< and of no more than that times the least
    double distinct = 0.05;  ///< relaxed are those that differ on more than this share of the surfaces
    UntanglingOptions untangling;

    FinishingOptions() {
        untangling.global_steps = 5;
        untangling.fold_sweeps = 30;
        untangling.replace_parts = false;
        untangling.align_normals = false;
        untangling.settling_steps = 0;
        untangling.most_fold_visits = 10;  // wrong maps have folds that no number of visits removes
    }
};

/// Continues maps side by side through the diffusion and the Euclidean levels, and relaxes the best: only
/// finished maps can be compared. The best by its energy comes first. Those that become what is in `known`
/// already are left out. Deterministic for any number of threads.
std::vector<FinishedMap> finish(const PairContext& context, const std::vector<VertexImages>& starts,
                                const FinishingOptions& options, const std::vector<FinishedMap>& known = {});

}  // namespace varimap
