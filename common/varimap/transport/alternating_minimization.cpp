#include "varimap/transport/alternating_minimization.h"

#include <fmt/format.h>

#include <cmath>

#include "varimap/core/error.h"

namespace varimap {

namespace {

/// A full plan of at most this many entries stays full: sparsity would save nothing. Chosen by hand.
constexpr long full_plan_entries = 10000;

/// C of Eq. (10): how far the transported masses may be from m' and n' within an alternation. Chosen by hand:
/// the paper gives no number.
constexpr double slack = 1.1;

/// The area bound: a factor of sqrt(B) on each side.
PlanBounds area_bounds(const Side& X, const Side& Y, const AlternationOptions& options) {
    const double D = std::sqrt(options.area_bound);
    return {MassBounds::around(X.mass, D), MassBounds::around(Y.mass, D)};
}

/// The area bound, and Eq. (10) around other masses.
PlanBounds bounds_around(const Eigen::VectorXd& row, const Eigen::VectorXd& column, const PlanBounds& area) {
    return {area.row.within(MassBounds::around(row, slack)),
            area.column.within(MassBounds::around(column, slack))};
}

/// What the plan's row and column sums must keep.
PlanBounds plan_bounds(const Side& X, const Side& Y, const RelaxedMasses& relaxed,
                       const AlternationOptions& options) {
    const PlanBounds area = area_bounds(X, Y, options);
    return relaxed.row.size() > 0 ? bounds_around(relaxed.row, relaxed.column, area) : area;
}

/// gamma from one divisor of the largest cost to another, in steps of 3.
struct Annealing {
    double largest, first_divisor, last_divisor;
};

/// Entropic transport with gamma annealed, each time solved as the options say. The problem's gamma is set
/// here.
SinkhornReport solve_annealed(TransportProblem problem, const Annealing& annealing,
                              const SinkhornOptions& options, Solution& solution) {
    SinkhornReport total;
    for (double divisor = std::min(annealing.first_divisor, annealing.last_divisor);; divisor *= 3) {
        divisor = std::min(divisor, annealing.last_divisor);
        problem.gamma = annealing.largest / divisor;
        const SinkhornReport report = sinkhorn(problem, options, solution.potentials, solution.plan);
        total = {total.iterations + report.iterations, report.marginal_error};
        if (divisor == annealing.last_divisor) return total;
    }
}

/// Row and column sums that keep the bounds of a plan.
struct Masses {
    Eigen::VectorXd row, column;
    Masses(const Coupling& plan, const PlanBounds& bounds)
        : row(bounds.row.projected(row_sums(plan))), column(bounds.column.projected(column_sums(plan))) {}
};

/// Solves for exactly the masses of the solution's plan, moved into the bounds, where they are further from
/// these than rounding should bridge. Starts from gamma = the largest cost: at small gamma potentials of
/// exact masses spread slowly.
SinkhornReport tighten(TransportProblem problem, double largest, const AlternationOptions& options,
                       Solution& solution) {
    // Chosen by hand on the known pairs, not swept: what rounding may move, and what it must not.
    constexpr double tolerance = 5e-3, failure = 5e-2;
    const Masses masses(solution.plan, {problem.row_bounds, problem.column_bounds});
    const double distance = std::max((masses.row - row_sums(solution.plan)).lpNorm<1>(),
                                     (masses.column - column_sums(solution.plan)).lpNorm<1>());
    if (distance <= tolerance) return {0, distance};
    problem.row_bounds = {masses.row, masses.row};
    problem.column_bounds = {masses.column, masses.column};
    const SinkhornReport report = solve_annealed(problem, {largest, 1, options.gamma_divisor},
                                                 {tolerance, options.sinkhorn_iterations}, solution);
    if (report.marginal_error > failure)
        throw ConvergenceError(
            fmt::format("the area bound cannot be kept: {:.2g}% of the mass is out of place after {} "
                        "Sinkhorn iterations; raise area_bound or sinkhorn_iterations",
                        100 * report.marginal_error, report.iterations));
    return report;
}

/// The averaging of a side whose samples are damped. A neighbourhood of which nothing would be left keeps its
/// weights.
Averaging damped_averaging(const Side& side, const Eigen::VectorXd& damping) {
    SparseMatrix damped = side.weights * damping.asDiagonal();
    const Eigen::VectorXd left = damped * side.mass;
    for (Eigen::Index k = 0; k < left.size(); ++k)
        if (left[k] == 0) damped.row(k) = side.weights.row(k);
    return {damped, side.mass};
}

}  // namespace

void AlternatingMinimization::start(const Centres& centres, const KeptEntries& kept) {
    const int rows = int(X_.mass.size()), columns = int(Y_.mass.size());
    solution_.step.centres = centres;
    pull_landmarks(X_, Y_, partners_, solution_.step.centres);
    solution_.relaxed = {};
    if (options_.area_energy == AreaEnergy::paper) solution_.relaxed = {X_.mass, Y_.mass};
    solution_.potentials = Potentials::zero(rows, columns);
    solution_.plan.support =
        kept.empty() ? Support::dense(rows, columns) : enlarged(kept, X_.neighbours, Y_.neighbours);
    fresh_ = true;
}

void AlternatingMinimization::set_damping(const std::optional<Damping>& damping) {
    damped_X_.reset();
    damped_Y_.reset();
    if (!damping) return;
    damped_X_ = damped_averaging(X_, damping->row);
    damped_Y_ = damped_averaging(Y_, damping->column);
}

void AlternatingMinimization::renew_support() {
    const long full = long(X_.mass.size()) * long(Y_.mass.size());
    if (full <= full_plan_entries && solution_.plan.support.entries() == full) return;
    const KeptEntries kept =
        significant_entries(solution_.plan, X_.mass, Y_.mass, options_.support_threshold);
    solution_.plan.support = enlarged(kept, X_.neighbours, Y_.neighbours);
}

/// The half-step over the plan, with the rest fixed. Returns the gamma that it ends with, too.
SinkhornReport AlternatingMinimization::solve_plan(Tightness tightness, double& gamma) {
    if (solution_.plan.support.entries() == 0)
        throw ConvergenceError(
            "nothing is left of the transport plan: samples of the hierarchies are their own neighbours no "
            "more; delete the hierarchies and rerun varimap-hierarchy");
    const Eigen::VectorXd cost =
        CostFactors(averaged_X(), averaged_Y(), solution_.step.centres, solution_.relaxed)
            .on(solution_.plan.support);
    if (!cost.allFinite())
        throw ConvergenceError(
            "costs of the transport plan are no numbers: coordinates are too large to be squared; scale both "
            "surfaces down");
    const double largest = std::max(cost.maxCoeff(), 1e-300);
    gamma = largest / options_.gamma_divisor;
    const PlanBounds bounds = plan_bounds(X_, Y_, solution_.relaxed, options_);
    const TransportProblem problem{solution_.plan.support,
                                   cost,
                                   X_.mass,
                                   Y_.mass,
                                   gamma,
                                   options_.background_factor * largest,
                                   bounds.row,
                                   bounds.column,
                                   options_.mass_penalty * largest};
    const double first_divisor = fresh_ ? options_.annealing_divisor : options_.gamma_divisor;
    const SinkhornReport report =
        solve_annealed(problem, {largest, first_divisor, options_.gamma_divisor},
                       {options_.marginal_tolerance, options_.sinkhorn_iterations}, solution_);
    if (tightness != Tightness::tight) return report;
    const SinkhornReport last = tighten(problem, largest, options_, solution_);
    return {report.iterations + last.iterations, last.marginal_error};
}

Alternation AlternatingMinimization::step(Tightness tightness) {
    if (!fresh_) renew_support();
    double gamma;
    const SinkhornReport sinkhorn = solve_plan(tightness, gamma);
    const AveragedSide X = averaged_X(), Y = averaged_Y();
    if (options_.area_energy == AreaEnergy::paper) {
        const Masses masses(solution_.plan, plan_bounds(X_, Y_, solution_.relaxed, options_));
        const PlanBounds bounds = bounds_around(masses.row, masses.column, area_bounds(X_, Y_, options_));
        solution_.relaxed = update_relaxed_masses(X, Y, solution_.plan, solution_.step.centres, bounds);
    }
    solution_.step = update_centres(X, Y, solution_.plan, solution_.relaxed, partners_);
    fresh_ = false;
    if (tightness == Tightness::tight) keep_bounds();
    return {solution_.step.energy, gamma, sinkhorn, solution_.plan.support.entries()};
}

void AlternatingMinimization::keep_bounds() {
    constexpr double tolerated = 1e-3;  // what the plan promises: within 0.1%
    const PlanBounds bounds = area_bounds(X_, Y_, options_);
    const Masses masses(solution_.plan, bounds);
    round_to_masses(masses.row, masses.column, solution_.plan);
    const double excess = std::max(bounds.row.excess(row_sums(solution_.plan)),
                                   bounds.column.excess(column_sums(solution_.plan)));
    if (excess > tolerated)
        throw ConvergenceError(
            fmt::format("transported masses leave the area bound by {:.2g}%; raise area_bound or "
                        "sinkhorn_iterations",
                        100 * excess));
}

void AlternatingMinimization::run(const Observer& observe) {
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
