#include "common/transport/alternating_minimization.h"

#include <cmath>

namespace varimap {

namespace {

/// A full plan of at most this many entries stays full: sparsity would save nothing.
constexpr long full_plan_entries = 10000;

struct PlanStep {
    double gamma;
    SinkhornReport sinkhorn;
};

/// Scales the plan to total mass 1, which relaxed marginals do not ensure.
void normalise(Coupling& plan) {
    const double total = row_sums(plan).sum();
    plan.value /= total;
    plan.row_background /= total;
}

/// One plan half-step with fixed centres: entropic transport, with gamma annealed down to its final value
/// from the given divisor of the largest cost.
PlanStep solve_plan(const Side& X, const Side& Y, double first_divisor, const AlternationOptions& options,
                    Solution& solution) {
    const Eigen::VectorXd cost = CostFactors(X, Y, solution.step.centres).on(solution.plan.support);
    const double largest = std::max(cost.maxCoeff(), 1e-300);
    PlanStep step{};
    for (double divisor = std::min(first_divisor, options.gamma_divisor);; divisor *= 3) {
        divisor = std::min(divisor, options.gamma_divisor);
        step.gamma = largest / divisor;
        TransportProblem problem{solution.plan.support, cost,       X.mass,
                                 Y.mass,                step.gamma, options.background_factor * largest};
        if (options.mass_penalty > 0) problem.mass_penalty = options.mass_penalty * largest;
        const SinkhornReport report = sinkhorn(problem, {options.marginal_tolerance, options.sinkhorn_iterations},
                                               solution.potentials, solution.plan);
        step.sinkhorn = {step.sinkhorn.iterations + report.iterations, report.marginal_error};
        if (divisor < options.gamma_divisor) continue;
        if (options.mass_penalty > 0) normalise(solution.plan);
        return step;
    }
}

}  // namespace

void AlternatingMinimization::start(const Centres& centres, const KeptEntries& kept) {
    const int rows = int(X_.mass.size()), columns = int(Y_.mass.size());
    solution_.step.centres = centres;
    solution_.potentials = Potentials::zero(rows, columns);
    solution_.plan.support = kept.empty() ? Support::dense(rows, columns) : enlarged(kept, X_.reach, Y_.reach);
    fresh_ = true;
}

void AlternatingMinimization::renew_support() {
    const long full = long(X_.mass.size()) * long(Y_.mass.size());
    if (full <= full_plan_entries && solution_.plan.support.entries() == full) return;
    const KeptEntries kept = significant_entries(solution_.plan, X_.mass, Y_.mass, options_.support_threshold);
    solution_.plan.support = enlarged(kept, X_.reach, Y_.reach);
}

Alternation AlternatingMinimization::step() {
    if (!fresh_) renew_support();
    const double first_divisor = fresh_ ? options_.annealing_divisor : options_.gamma_divisor;
    const PlanStep plan = solve_plan(X_, Y_, first_divisor, options_, solution_);
    solution_.step = update_centres(X_, Y_, solution_.plan);
    fresh_ = false;
    return {solution_.step.energy, plan.gamma, plan.sinkhorn, solution_.plan.support.entries()};
}

void AlternatingMinimization::run(const std::function<void(const Alternation&)>& observe) {
    double previous = 0;
    for (int iteration = 0; iteration < options_.maximum_alternations; ++iteration) {
        const Alternation alternation = step();
        observe(alternation);
        const bool settled = std::abs(previous - alternation.energy) <= options_.tolerance * previous;
        previous = alternation.energy;
        if (iteration > 0 && settled) break;
    }
}

}  // namespace varimap
