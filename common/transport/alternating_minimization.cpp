#include "common/transport/alternating_minimization.h"

#include <cmath>

namespace varimap {

namespace {

/// One plan half-step with fixed centres: entropic transport, with gamma annealed down to its final value
/// from the given divisor of the largest cost.
struct PlanStep {
    double gamma;
    SinkhornReport sinkhorn;
};
PlanStep solve_plan(const Side& X, const Side& Y, const Centres& centres, double first_divisor,
                    const AlternationOptions& options, Potentials& potentials, Coupling& plan) {
    const Eigen::VectorXd cost = CostFactors(X, Y, centres).on(plan.support);
    const double largest = std::max(cost.maxCoeff(), 1e-300);
    PlanStep step{};
    for (double divisor = std::min(first_divisor, options.gamma_divisor);; divisor *= 3) {
        divisor = std::min(divisor, options.gamma_divisor);
        step.gamma = largest / divisor;
        const TransportProblem problem{plan.support, cost,       X.mass,
                                       Y.mass,       step.gamma, options.background_factor * largest};
        const SinkhornReport report =
            sinkhorn(problem, {options.marginal_tolerance, options.sinkhorn_iterations}, potentials, plan);
        step.sinkhorn = {step.sinkhorn.iterations + report.iterations, report.marginal_error};
        if (divisor >= options.gamma_divisor) return step;
    }
}

}  // namespace

Solution minimize_alternatingly(const Side& X, const Side& Y, const Centres& start, const KeptEntries& kept,
                                const AlternationOptions& options,
                                const std::function<void(const Alternation&)>& observe) {
    Solution solution;
    solution.step.centres = start;
    Potentials potentials = Potentials::zero(int(X.mass.size()), int(Y.mass.size()));
    double previous = 0;
    for (int iteration = 0; iteration < options.maximum_alternations; ++iteration) {
        if (iteration == 0)
            solution.plan.support = kept.empty() ? Support::dense(int(X.mass.size()), int(Y.mass.size()))
                                                 : enlarged(kept, X.weights, Y.weights);
        else if (!kept.empty())
            solution.plan.support =
                enlarged(significant_entries(solution.plan, X.mass, Y.mass, options.support_threshold), X.weights,
                         Y.weights);
        const double first_divisor = iteration == 0 ? options.annealing_divisor : options.gamma_divisor;
        const PlanStep plan_step =
            solve_plan(X, Y, solution.step.centres, first_divisor, options, potentials, solution.plan);
        solution.step = update_centres(X, Y, solution.plan);
        observe({iteration, solution.step.energy, plan_step.gamma, plan_step.sinkhorn, solution.plan.support.entries()});
        const bool settled = std::abs(previous - solution.step.energy) <= options.tolerance * previous;
        previous = solution.step.energy;
        if (iteration > 0 && settled) break;
    }
    return solution;
}

}  // namespace varimap
