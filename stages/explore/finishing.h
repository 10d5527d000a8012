#pragma once

#include <functional>
#include <vector>

#include "stages/explore/appraisal.h"
#include "varimap/multilevel/descriptor_terms.h"
#include "varimap/multilevel/ironing.h"
#include "varimap/multilevel/matching.h"
#include "varimap/transport/alternating_minimization.h"
#include "varimap/untangling/untangling_options.h"

namespace varimap {

struct FinishingOptions {
    AlternationOptions alternation;
    IroningOptions ironing;
    DescriptorWeights descriptors;  ///< as in varimap-diffuse and varimap-refine
    /// Rounds of ironing on the Euclidean levels, where mirrored limbs are placed anew in any case: left as
    /// they are, they make the right map look worse than a wrong one.
    int euclidean_rounds = 3;
    /// Maps that go on from the first level, and from the Euclidean ones: those whose rough scores
    /// (appraisal.h) are within so much of the best, known ones included, and in any case the best, and, if
    /// none is known, the best that is elsewhere on most of the surfaces, without which the choice would seem
    /// surer than it is. On 68 pairs, half of a list and generated ones, with all maps finished, the best had
    /// a rough score within 4.2 and 3.4 of the least, and no map that these numbers leave out came within 2.3
    /// of the best.
    double gap_at_first = 5, gap = 4;
    int most = 4;            ///< maps that reach the last level at most
    double distinct = 0.05;  ///< relaxed are those that differ on more than this share of the surfaces
    UntanglingOptions untangling;

    FinishingOptions() {
        untangling.global_steps = 5;
        untangling.fold_sweeps = 30;
        untangling.replace_parts = false;
        untangling.align_normals = false;
        untangling.settling_steps = 0;
        untangling.weigh_relief = false;   // it tells right maps from wrong ones
        untangling.most_fold_visits = 10;  // wrong maps have folds that no number of visits removes
    }
};

/// A map to be finished: what it matches on a level.
using MapStart = std::function<Matching(const LevelPair&)>;

/// Continues maps side by side through a diffusion level and the Euclidean ones, drops the worse ones on the
/// way, and relaxes the rest: only finished maps can be compared with confidence. That of the best rough
/// score comes first. Those that become what is in `known` already are left out. Deterministic for any number
/// of threads.
std::vector<FinishedMap> finish(const PairContext& context, const Appraisal& appraisal,
                                const std::vector<MapStart>& starts, const FinishingOptions& options,
                                const std::vector<FinishedMap>& known = {});

/// Cues of one start or more, in their order, when they are solved for in the same way, but none dropped and
/// none relaxed: on the first Euclidean level where the first is clearly the best, or on the last.
std::vector<Cues> cues_when_solved(const PairContext& context, const Appraisal& appraisal,
                                   const std::vector<MapStart>& starts, const FinishingOptions& options);

}  // namespace varimap
