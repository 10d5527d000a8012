#include "varimap/transport/alternating_minimization.h"

#include <fmt/format.h>

#include <cmath>

#include "varimap/core/error.h"

namespace varimap {

namespace {

/// A full plan of at most this many entries stays full: sparsity would save nothing.
constexpr long full_plan_entries = 10000;

/// C of Eq. (10): how far the transported masses may be from m' and n' within an alternation.
constexpr double slack = 1.1;

struct Bounds {
    MassBounds row, column;
};

/// The area bound: a factor of sqrt(B) on each side.
Bounds area_bounds(const Side& X, const Side& Y, const AlternationOptions& options) {
    const double D = std::sqrt(options.area_bound);
    return {MassBounds::around(X.mass, D), MassBounds::around(Y.mass, D)};
}

/// The area bound, and Eq. (10) around other masses.
Bounds bounds_around(const Eigen::VectorXd& row, const Eigen::VectorXd& column, const Bounds& area) {
    return {area.row.within(MassBounds::around(row, slack)),
            area.column.within(MassBounds::around(column, slack))};
}

/// What the plan's row and column sums must keep.
Bounds plan_bounds(const Side& X, const Side& Y, const RelaxedMasses& relaxed,
                   const AlternationOptions& options) {
    const Bounds area = area_bounds(X, Y, options);
    return relaxed.row.size() > 0 ? bounds_around(relaxed.row, relaxed.column, area) : area;
}

struct PlanStep {
    double gamma;
    SinkhornReport sinkhorn;
};

/// Entropic transport with gamma annealed from the given divisor of the largest cost, in steps of 3, down to
/// its final value, each time to the given tolerance. The problem's gamma is set here.
PlanStep solve_annealed(TransportProblem problem, double largest, double first_divisor, double tolerance,
                        const AlternationOptions& options, Solution& solution) {
    PlanStep step{};
    for (double divisor = std::min(first_divisor, options.gamma_divisor);; divisor *= 3) {
        divisor = std::min(divisor, options.gamma_divisor);
        problem.gamma = step.gamma = largest / divisor;
        const SinkhornReport report =
            sinkhorn(problem, {tolerance, options.sinkhorn_iterations}, solution.potentials, solution.plan);
        step.sinkhorn = {step.sinkhorn.iterations + report.iterations, report.marginal_error};
        if (divisor == options.gamma_divisor) return step;
    }
}

/// Row and column sums that keep the bounds of a plan.
struct Masses {
    Eigen::VectorXd row, column;
    Masses(const Coupling& plan, const Bounds& bounds)
        : row(bounds.row.projected(row_sums(plan))), column(bounds.column.projected(column_sums(plan))) {}
};

/// Solves for exactly the masses of the solution's plan, moved into the bounds, where they are further from
/// these than rounding should bridge. Starts from gamma = the largest cost: at small gamma potentials of
/// exact masses spread slowly.
SinkhornReport tighten(TransportProblem problem, double largest, const AlternationOptions& options,
                       Solution& solution) {
    constexpr double tolerance = 5e-3, failure = 5e-2;
    const Masses masses(solution.plan, {problem.row_bounds, problem.column_bounds});
    const double distance = std::max((masses.row - row_sums(solution.plan)).lpNorm<1>(),
                                     (masses.column - column_sums(solution.plan)).lpNorm<1>());
    if (distance <= tolerance) return {0, distance};
    problem.row_bounds = {masses.row, masses.row};
    problem.column_bounds = {masses.column, masses.column};
    const SinkhornReport report = solve_annealed(problem, largest, 1, tolerance, options, solution).sinkhorn;
    if (report.marginal_error > failure)
        throw ConvergenceError(
            fmt::format("the area bound cannot be kept: {:.2g}% of the mass is out of place after {} "
                        "Sinkhorn iterations; raise area_bound or sinkhorn_iterations",
                        100 * report.marginal_error, report.iterations));
    return report;
}

/// One plan half-step with the rest fixed.
PlanStep solve_plan(const Side& X, const Side& Y, double first_divisor, bool tight,
                    const AlternationOptions& options, Solution& solution) {
    const Eigen::VectorXd cost =
        CostFactors(X, Y, solution.step.centres, solution.relaxed).on(solution.plan.support);
    const double largest = std::max(cost.maxCoeff(), 1e-300);
    const Bounds bounds = plan_bounds(X, Y, solution.relaxed, options);
    const TransportProblem problem{solution.plan.support,
                                   cost,
                                   X.mass,
                                   Y.mass,
                                   0,
                                   options.background_factor * largest,
                                   bounds.row,
                                   bounds.column,
                                   options.mass_penalty * largest};
    PlanStep step =
        solve_annealed(problem, largest, first_divisor, options.marginal_tolerance, options, solution);
    if (tight) {
        const SinkhornReport last = tighten(problem, largest, options, solution);
        step.sinkhorn = {step.sinkhorn.iterations + last.iterations, last.marginal_error};
    }
    return step;
}

}  // namespace

void AlternatingMinimization::start(const Centres& centres, const KeptEntries& kept) {
    const int rows = int(X_.mass.size()), columns = int(Y_.mass.size());
    solution_.step.centres = centres;
    solution_.relaxed = {};
    if (options_.area_energy == "paper") solution_.relaxed = {X_.mass, Y_.mass};
    solution_.potentials = Potentials::zero(rows, columns);
    solution_.plan.support =
        kept.empty() ? Support::dense(rows, columns) : enlarged(kept, X_.reach, Y_.reach);
    fresh_ = true;
}

void AlternatingMinimization::renew_support() {
    const long full = long(X_.mass.size()) * long(Y_.mass.size());
    if (full <= full_plan_entries && solution_.plan.support.entries() == full) return;
    const KeptEntries kept =
        significant_entries(solution_.plan, X_.mass, Y_.mass, options_.support_threshold);
    solution_.plan.support = enlarged(kept, X_.reach, Y_.reach);
}

Alternation AlternatingMinimization::step(bool tight) {
    if (!fresh_) renew_support();
    const double first_divisor = fresh_ ? options_.annealing_divisor : options_.gamma_divisor;
    const PlanStep plan = solve_plan(X_, Y_, first_divisor, tight, options_, solution_);
    if (options_.area_energy == "paper") {
        const Masses masses(solution_.plan, plan_bounds(X_, Y_, solution_.relaxed, options_));
        const Bounds bounds = bounds_around(masses.row, masses.column, area_bounds(X_, Y_, options_));
        solution_.relaxed =
            update_relaxed_masses(X_, Y_, solution_.plan, solution_.step.centres, bounds.row, bounds.column);
    }
    solution_.step = update_centres(X_, Y_, solution_.plan, solution_.relaxed);
    fresh_ = false;
    if (tight) keep_bounds();
    return {solution_.step.energy, plan.gamma, plan.sinkhorn, solution_.plan.support.entries()};
}

void AlternatingMinimization::keep_bounds() {
    constexpr double tolerated = 1e-3;
    const Bounds bounds = area_bounds(X_, Y_, options_);
    const Masses masses(solution_.plan, bounds);
    round_to_masses(masses.row, masses.column, solution_.plan);
    const double excess = std::max(bounds.row.excess(row_sums(solution_.plan)),
                                   bounds.column.excess(column_sums(solution_.plan)));
    if (excess > tolerated)
        throw ConvergenceError(
            fmt::format("transported masses leave the area bound by {:.2g}%", 100 * excess));
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
