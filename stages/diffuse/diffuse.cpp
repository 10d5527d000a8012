#include "stages/diffuse/diffuse.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/mapping/compared_terms.h"
#include "common/mapping/orientation.h"
#include "common/mapping/solve_level.h"
#include "common/stage/error.h"
#include "common/stage/parallel.h"
#include "stages/diffuse/landmark_check.h"

namespace varimap {

namespace {

RowMatrix sample_positions(const Surface& surface, const Level& level) {
    return surface.mesh.vertices(level.samples, Eigen::all);
}

/// Centres of the Wasserstein-2 plan between positions in space (Sec. 5, Initialization).
Centres wasserstein_centres(const LevelPair& pair, const PairContext& context, const AlternationOptions& options) {
    const RowMatrix a = sample_positions(context.A().surface, pair.A.level);
    const RowMatrix b = sample_positions(context.B().surface, pair.B.level);
    Coupling plan;
    plan.support = Support::dense(int(a.rows()), int(b.rows()));
    Eigen::VectorXd cost(plan.support.entries());
    for (Eigen::Index i = 0; i < a.rows(); ++i)
        for (Eigen::Index j = 0; j < b.rows(); ++j) cost[i * b.rows() + j] = (a.row(i) - b.row(j)).squaredNorm();
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

/// Column of the largest entry of each row.
std::vector<int> best_partners(const SparseMatrix& plan) {
    std::vector<int> best(plan.rows(), 0);
    for (int i = 0; i < plan.outerSize(); ++i) {
        double largest = -1;
        for (SparseMatrix::InnerIterator it(plan, i); it; ++it)
            if (it.value() > largest) largest = it.value(), best[i] = int(it.col());
    }
    return best;
}

/// For every vertex of one mesh: the position of the other mesh's vertex nearest to its centre in the embedding.
Points vertex_positions(const LevelSide& from, const LevelSide& to, const RowMatrix& sample_image, const SparseMatrix& plan,
                        const Surface& target, const GeodesicGraph& target_graph) {
    const std::vector<int> best = best_partners(plan);
    Points positions(from.level.cell.size(), 3);
    parallel_for_each_index(size_t(0) + from.level.cell.size(), size_t(64), [&](size_t v) {
        const int k = from.level.cell[v];
        const auto here = from.vertex_points.row(v);
        // The vertex's own neighbourhood (Eq. 7), among the samples of its cell's neighbourhood.
        Eigen::RowVectorXd centre = Eigen::RowVectorXd::Zero(sample_image.cols());
        double total = 0;
        for (SparseMatrix::InnerIterator it(from.side.weights, k); it; ++it) {
            const auto there = from.side.points.row(it.col());
            const double w = 2 * here.dot(there) / (here.squaredNorm() + there.squaredNorm());
            if (w < 0.5 && it.col() != k) continue;
            total += from.side.mass[it.col()] * std::max(w, 0.0);
            centre += from.side.mass[it.col()] * std::max(w, 0.0) * sample_image.row(it.col());
        }
        const int start = to.level.samples[best[k]];
        const int image = total > 0 ? nearest_by_descent(start, centre / total, to.vertex_points, target_graph) : start;
        positions.row(v) = target.mesh.vertices.row(image);
    });
    return positions;
}

Plan to_plan(const LevelPair& pair, const Solution& solution, const PairContext& context) {
    Plan plan;
    plan.samples_A = pair.A.level.samples;
    plan.samples_B = pair.B.level.samples;
    plan.mass_A = pair.A.side.mass;
    plan.mass_B = pair.B.side.mass;
    plan.transported_A = row_sums(solution.plan);
    plan.transported_B = column_sums(solution.plan);
    plan.plan = to_matrix(solution.plan, plan.mass_A, plan.mass_B);
    plan.position_A = vertex_positions(pair.A, pair.B, solution.step.row_image, plan.plan, context.B().surface,
                                       context.graph_B());
    plan.position_B = vertex_positions(pair.B, pair.A, solution.step.column_image, plan.plan.transpose(),
                                       context.A().surface, context.graph_A());
    plan.landmarks = context.landmarks();
    plan.landmark_weight = context.landmark_weight();
    return plan;
}

/// Where the levels go on: a solved level and the index of the next.
struct Solved {
    LevelPair pair;
    Coupling plan;
    int next = 0;
};

Solved chosen_candidate(const PairContext& context, const Candidates& candidates, int number) {
    if (number > int(candidates.plans.size()))
        throw UsageError(fmt::format("candidate {}: varimap-explore found {}", number, candidates.plans.size()));
    for (int l = 0; l < context.diffusion_levels(); ++l) {
        LevelPair pair = context.diffusion_level(l);
        if (pair.A.level.samples == candidates.samples_A && pair.B.level.samples == candidates.samples_B)
            return {std::move(pair), to_coupling(candidates.plans[number - 1]), l + 1};
    }
    throw ArtifactError("the candidates' samples are not those of a level of these hierarchies; rerun varimap-explore");
}

}  // namespace

Plan diffuse(const PairContext& context, const DiffuseParams& params, const std::optional<Candidates>& candidates) {
    const int levels = params.levels > 0 ? std::min(params.levels, context.diffusion_levels()) : context.diffusion_levels();
    std::vector<TraceRow> trace;
    Solved coarse;
    if (candidates) coarse = chosen_candidate(context, *candidates, params.candidate);
    Solution solution;
    const FeatureTerm features(context, params.feature_weight);
    // At least one level: a candidate on the last one is solved there once more.
    for (int l = std::min(coarse.next, levels - 1); l < levels; ++l) {
        LevelPair pair = context.diffusion_level(l);
        if (params.wasserstein_weight > 0) add_wasserstein_term(pair, context, params.wasserstein_weight);
        features.add_to(pair);
        const Start start = l == 0 && !candidates ? coarsest_start(pair, context, params)
                                                  : hand_down(coarse.plan, coarse.pair.A.level, coarse.pair.B.level, pair,
                                                              params.alternation.support_threshold);
        solution = solve_level(context, pair, start, l, params.alternation, params.ironing, l + 1 == levels, trace);
        coarse = {std::move(pair), solution.plan, l + 1};
    }
    Plan plan = to_plan(coarse.pair, solution, context);
    plan.area_bound = params.alternation.area_bound;
    plan.trace = std::move(trace);
    if (params.check_landmarks) plan.landmark_checks = check_landmarks(context, params.alternation);
    if (candidates) {
        plan.candidates = candidates->list;
        plan.candidate = params.candidate;
    }
    return plan;
}

}  // namespace varimap
