#include "stages/refine/refine.h"

#include <fmt/format.h>

#include <algorithm>

#include "varimap/core/error.h"
#include "varimap/multilevel/descent.h"
#include "varimap/multilevel/descriptor_terms.h"
#include "varimap/multilevel/sparse_plan.h"
#include "varimap/multilevel/wasserstein_centres.h"

namespace varimap {

namespace {

LevelPair level_with_terms(int index, const PairContext& context, const RefineParams& params) {
    const bool last = index + 1 == context.euclidean_levels();
    LevelPair pair = context.euclidean_level(index, last ? params.last_metric_weight : params.metric_weight);
    add_descriptor_terms(pair, context, params.descriptors);
    return pair;
}

/// The level with its points in space, whatever its embedding.
LevelPair in_space(LevelPair level, const PairContext& context) {
    const auto place = [](LevelSide& side, const Domain& domain) {
        side.vertex_points = domain.mesh.vertices;
        side.side.points = sample_positions(domain, side.level);
    };
    place(level.A, context.A().surface);
    place(level.B, context.B().surface);
    return level;
}

bool has_coordinates(const PairContext& context) {
    return context.A().surface.coordinates.size() > 0 || context.B().surface.coordinates.size() > 0;
}

/// Stopped early, a plan is spread to every vertex as a level switch would do it.
Centres spread(const Coupling& plan, TracedDescent& descent, const PairContext& context,
               const RefineParams& params) {
    LevelPair last = context.euclidean_level(context.euclidean_levels() - 1, params.last_metric_weight);
    descent.enter(has_coordinates(context) ? in_space(std::move(last), context) : std::move(last));
    const LevelPair& level = descent.level();
    Centres centres = descent.hand_down(plan).centres;
    pull_landmarks(level.A.side, level.B.side, level.partners, centres);
    return centres;
}

/// The plan's centres in space, though it was found in other coordinates.
Centres centres_in_space(const LevelPair& level, const Solution& solution, const PairContext& context) {
    const LevelPair placed = in_space(level, context);
    Centres centres = update_centres(placed.A.side, placed.B.side, solution.plan, solution.relaxed).centres;
    pull_landmarks(placed.A.side, placed.B.side, placed.partners, centres);
    return centres;
}

Points space_part(const RowMatrix& centres) {
    return centres.leftCols<3>();
}

/// The first level to solve: where nothing is handed down, that of all points.
int first_level(const PairContext& context, const RefineParams& params) {
    if (params.start == RefineStart::diffusion) return 0;
    const int points = std::max(int(context.A().surface.mass.size()), int(context.B().surface.mass.size()));
    constexpr int most_points = 3000;  // every pair of points has an entry
    if (points > most_points)
        throw UsageError(
            fmt::format("--start wasserstein: {} points are too many for a plan with all entries, "
                        "{} are allowed; start from the diffusion",
                        points, most_points));
    return context.euclidean_levels() - 1;
}

}  // namespace

Plan refine(const PairContext& context, const Diffusion& diffusion, const RefineParams& params) {
    const int all = context.euclidean_levels();
    const int first = first_level(context, params);
    const int levels = params.levels > 0 ? std::min(first + params.levels, all) : all;
    const int first_index = diffusion.trace.empty() ? 0 : diffusion.trace.back().level + 1;
    TracedDescent descent(context, params.alternation, params.ironing, diffusion.trace);
    descent.resume(diffusion.plan.samples_A, diffusion.plan.samples_B, "varimap-diffuse");
    Solution solution;
    solution.plan = to_coupling(diffusion.plan.entries);
    for (int l = first; l < levels; ++l) {
        descent.enter(level_with_terms(l, context, params));
        const bool anew = l == first && params.start == RefineStart::wasserstein;
        const Start start = anew
                                ? Start{wasserstein_centres(descent.level(), context, params.alternation), {}}
                                : descent.hand_down(solution.plan);
        solution = descent.solve(start, {.index = first_index + l,
                                         // Neighbourhoods of the last level are too small to move a patch.
                                         .ironed = l + 1 < all,
                                         .last = l + 1 == levels});
    }
    Plan plan;
    plan.plan = to_sample_plan(descent.level(), solution.plan, params.alternation.area_bound);
    const Centres centres = levels < all               ? spread(solution.plan, descent, context, params)
                            : has_coordinates(context) ? centres_in_space(descent.level(), solution, context)
                                                       : solution.step.centres;
    plan.centre_A = space_part(centres.row);
    plan.centre_B = space_part(centres.column);
    if (!plan.centre_A.allFinite() || !plan.centre_B.allFinite())
        throw ConvergenceError("centres are not finite; lower refine.gamma_divisor");
    plan.trace = descent.take_trace();
    plan.record = diffusion.record;
    return plan;
}

}  // namespace varimap
