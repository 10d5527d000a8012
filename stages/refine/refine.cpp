#include "stages/refine/refine.h"

#include <algorithm>

#include "varimap/core/error.h"
#include "varimap/multilevel/compared_terms.h"
#include "varimap/multilevel/solve_level.h"

namespace varimap {

namespace {

/// The level that the diffusion plan lives on, rebuilt from its samples (cells are all a level switch needs).
LevelPair diffusion_levels_of(const PairContext& context, const SamplePlan& diffusion) {
    for (int l = context.diffusion_levels() - 1; l >= 0; --l) {
        LevelPair pair = context.diffusion_level(l);
        if (pair.A.level.samples == diffusion.samples_A && pair.B.level.samples == diffusion.samples_B)
            return pair;
    }
    throw ArtifactError(
        "the diffusion plan's samples are not those of a level of these hierarchies; rerun varimap-diffuse");
}

Points space_part(const RowMatrix& centres) {
    return centres.leftCols<3>();
}

SamplePlan to_plan(const LevelPair& pair, const Solution& solution) {
    SamplePlan plan;
    plan.samples_A = pair.A.level.samples;
    plan.samples_B = pair.B.level.samples;
    plan.mass_A = pair.A.side.mass;
    plan.mass_B = pair.B.side.mass;
    plan.transported_A = row_sums(solution.plan);
    plan.transported_B = column_sums(solution.plan);
    plan.entries = to_matrix(solution.plan, plan.mass_A, plan.mass_B);
    return plan;
}

}  // namespace

Plan refine(const PairContext& context, const Diffusion& diffusion, const RefineParams& params) {
    const int all = context.euclidean_levels();
    const int levels = params.levels > 0 ? std::min(params.levels, all) : all;
    Trace trace = diffusion.trace;
    const int first_index = trace.empty() ? 0 : trace.back().level + 1;

    LevelPair coarse = diffusion_levels_of(context, diffusion.plan);
    const FeatureTerm features(context, params.feature_weight);
    Solution solution;
    solution.plan = to_coupling(diffusion.plan.entries);
    for (int l = 0; l < levels; ++l) {
        LevelPair pair =
            context.euclidean_level(l, l + 1 == all ? params.last_metric_weight : params.metric_weight);
        features.add_to(pair);
        const Start start = hand_down(solution.plan, coarse.A.level, coarse.B.level, pair,
                                      params.alternation.support_threshold);
        IroningOptions ironing = params.ironing;
        ironing.enabled &= l + 1 < all;  // neighbourhoods of the last level are too small to move a patch
        solution = solve_level(context, pair, start, first_index + l, params.alternation, ironing,
                               l + 1 == levels, trace);
        coarse = std::move(pair);
    }
    Plan plan;
    plan.plan = to_plan(coarse, solution);
    plan.plan.area_bound = params.alternation.area_bound;
    // Stopped early, the plan is spread to every vertex as a level switch would do it.
    const Centres centres = levels == all
                                ? solution.step.centres
                                : hand_down(solution.plan, coarse.A.level, coarse.B.level,
                                            context.euclidean_level(all - 1, params.last_metric_weight),
                                            params.alternation.support_threshold)
                                      .centres;
    plan.centre_A = space_part(centres.row);
    plan.centre_B = space_part(centres.column);
    if (!plan.centre_A.allFinite() || !plan.centre_B.allFinite())
        throw ConvergenceError("centres are not finite; rerun varimap-refine with a larger gamma");
    plan.trace = std::move(trace);
    plan.record = diffusion.record;
    return plan;
}

}  // namespace varimap
