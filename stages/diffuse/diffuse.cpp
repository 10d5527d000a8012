#include "stages/diffuse/diffuse.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "stages/diffuse/check_landmarks.h"
#include "varimap/core/error.h"
#include "varimap/multilevel/compared_terms.h"
#include "varimap/multilevel/solve_level.h"
#include "varimap/multilevel/vertex_images.h"

namespace varimap {

namespace {

/// Centres of the Wasserstein-2 plan between positions in space (Sec. 5, Initialization).
Centres wasserstein_centres(const LevelPair& pair, const PairContext& context,
                            const AlternationOptions& options) {
    const RowMatrix a = sample_positions(context.A().surface, pair.A.level);
    const RowMatrix b = sample_positions(context.B().surface, pair.B.level);
    Coupling plan;
    plan.support = Support::dense(int(a.rows()), int(b.rows()));
    Eigen::VectorXd cost(plan.support.entries());
    for (Eigen::Index i = 0; i < a.rows(); ++i)
        for (Eigen::Index j = 0; j < b.rows(); ++j)
            cost[i * b.rows() + j] = (a.row(i) - b.row(j)).squaredNorm();
    Potentials potentials = Potentials::zero(int(a.rows()), int(b.rows()));
    const TransportProblem problem{plan.support,
                                   cost,
                                   pair.A.side.mass,
                                   pair.B.side.mass,
                                   cost.maxCoeff() / options.gamma_divisor,
                                   cost.maxCoeff() * options.background_factor};
    sinkhorn(problem, {options.marginal_tolerance, options.sinkhorn_iterations}, potentials, plan);
    return update_centres(pair.A.side, pair.B.side, plan).centres;
}

/// Coarsest level: the full plan, from centres at the origin unless the surfaces are aligned.
Start coarsest_start(const LevelPair& pair, const PairContext& context, const DiffuseParams& params) {
    Start start = zero_start(pair);
    if (params.start == "wasserstein") {
        start.centres = wasserstein_centres(pair, context, params.alternation);
        pull_landmarks(pair.A.side, pair.B.side, start.centres);
    }
    return start;
}

Diffusion to_diffusion(const LevelPair& pair, const Solution& solution, const PairContext& context) {
    Diffusion diffusion;
    SamplePlan& plan = diffusion.plan;
    plan.samples_A = pair.A.level.samples;
    plan.samples_B = pair.B.level.samples;
    plan.mass_A = pair.A.side.mass;
    plan.mass_B = pair.B.side.mass;
    plan.transported_A = row_sums(solution.plan);
    plan.transported_B = column_sums(solution.plan);
    plan.entries = to_matrix(solution.plan, plan.mass_A, plan.mass_B);
    diffusion.image_vertex_A =
        vertex_images(pair.A, pair.B, solution.step.row_image, plan.entries, context.graph_B());
    diffusion.image_vertex_B = vertex_images(pair.B, pair.A, solution.step.column_image,
                                             plan.entries.transpose(), context.graph_A());
    diffusion.record.landmarks = context.landmarks();
    diffusion.record.landmark_weight = context.landmark_weight();
    return diffusion;
}

/// Where the levels go on: a solved level and the index of the next.
struct Solved {
    LevelPair pair;
    Coupling plan;
    int next = 0;
};

Solved chosen_candidate(const PairContext& context, const Candidates& candidates, int number) {
    if (number > int(candidates.plans.size()))
        throw UsageError(
            fmt::format("candidate {}: varimap-explore found {}", number, candidates.plans.size()));
    for (int l = 0; l < context.diffusion_levels(); ++l) {
        LevelPair pair = context.diffusion_level(l);
        if (pair.A.level.samples == candidates.samples_A && pair.B.level.samples == candidates.samples_B)
            return {std::move(pair), to_coupling(candidates.plans[number - 1]), l + 1};
    }
    throw ArtifactError(
        "the candidates' samples are not those of a level of these hierarchies; rerun varimap-explore");
}

}  // namespace

Diffusion diffuse(const PairContext& context, const DiffuseParams& params,
                  const std::optional<Candidates>& candidates) {
    const int levels =
        params.levels > 0 ? std::min(params.levels, context.diffusion_levels()) : context.diffusion_levels();
    Trace trace;
    Solved coarse;
    if (candidates) coarse = chosen_candidate(context, *candidates, params.candidate);
    Solution solution;
    const FeatureTerm features(context, params.feature_weight);
    // At least one level: a candidate on the last one is solved there once more.
    for (int l = std::min(coarse.next, levels - 1); l < levels; ++l) {
        LevelPair pair = context.diffusion_level(l);
        if (params.wasserstein_weight > 0) add_wasserstein_term(pair, context, params.wasserstein_weight);
        features.add_to(pair);
        const Start start = l == 0 && !candidates
                                ? coarsest_start(pair, context, params)
                                : hand_down(coarse.plan, coarse.pair.A.level, coarse.pair.B.level, pair,
                                            params.alternation.support_threshold);
        solution =
            solve_level(context, pair, start, l, params.alternation, params.ironing, l + 1 == levels, trace);
        coarse = {std::move(pair), solution.plan, l + 1};
    }
    Diffusion diffusion = to_diffusion(coarse.pair, solution, context);
    diffusion.plan.area_bound = params.alternation.area_bound;
    diffusion.trace = std::move(trace);
    if (params.check_landmarks)
        diffusion.record.landmark_checks = check_landmarks(context, params.alternation);
    if (candidates) {
        diffusion.record.candidates = candidates->list;
        diffusion.record.candidate = params.candidate;
    }
    return diffusion;
}

}  // namespace varimap
