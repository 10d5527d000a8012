#include "stages/refine/refine.h"

#include <algorithm>

#include "varimap/core/error.h"
#include "varimap/multilevel/descent.h"
#include "varimap/multilevel/descriptor_terms.h"
#include "varimap/multilevel/sparse_plan.h"

namespace varimap {

namespace {

LevelPair level_with_terms(int index, const PairContext& context, const RefineParams& params) {
    const bool last = index + 1 == context.euclidean_levels();
    LevelPair pair = context.euclidean_level(index, last ? params.last_metric_weight : params.metric_weight);
    add_shape_term(pair, context, params.shape_weight);
    return pair;
}

/// Stopped early, a plan is spread to every vertex as a level switch would do it.
Centres spread(const Coupling& plan, TracedDescent& descent, const PairContext& context,
               const RefineParams& params) {
    descent.enter(context.euclidean_level(context.euclidean_levels() - 1, params.last_metric_weight));
    const LevelPair& level = descent.level();
    Centres centres = descent.hand_down(plan).centres;
    pull_landmarks(level.A.side, level.B.side, level.partners, centres);
    return centres;
}

Points space_part(const RowMatrix& centres) {
    return centres.leftCols<3>();
}

}  // namespace

Plan refine(const PairContext& context, const Diffusion& diffusion, const RefineParams& params) {
    const int all = context.euclidean_levels();
    const int levels = params.levels > 0 ? std::min(params.levels, all) : all;
    const int first_index = diffusion.trace.empty() ? 0 : diffusion.trace.back().level + 1;
    TracedDescent descent(context, params.alternation, params.ironing, diffusion.trace);
    descent.resume(diffusion.plan.samples_A, diffusion.plan.samples_B, "varimap-diffuse");
    Solution solution;
    solution.plan = to_coupling(diffusion.plan.entries);
    for (int l = 0; l < levels; ++l) {
        descent.enter(level_with_terms(l, context, params));
        solution = descent.solve(descent.hand_down(solution.plan),
                                 {.index = first_index + l,
                                  // Neighbourhoods of the last level are too small to move a patch.
                                  .ironed = l + 1 < all,
                                  .last = l + 1 == levels});
    }
    Plan plan;
    plan.plan = to_sample_plan(descent.level(), solution.plan, params.alternation.area_bound);
    const Centres centres =
        levels == all ? solution.step.centres : spread(solution.plan, descent, context, params);
    plan.centre_A = space_part(centres.row);
    plan.centre_B = space_part(centres.column);
    if (!plan.centre_A.allFinite() || !plan.centre_B.allFinite())
        throw ConvergenceError("centres are not finite; rerun varimap-refine with a larger gamma");
    plan.trace = descent.take_trace();
    plan.record = diffusion.record;
    return plan;
}

}  // namespace varimap
