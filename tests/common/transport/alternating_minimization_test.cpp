#include "varimap/transport/alternating_minimization.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fixtures/known_pair.h"
#include "fixtures/random_plan.h"
#include "varimap/core/error.h"

namespace varimap {
namespace {

using random_plan::dense;
using random_plan::energy;

shapes::KnownPair tubes() {
    return shapes::known_pair(shapes::tube(40, 20, true), shapes::tube(36, 18, true, .4),
                              shapes::tube_pose(1), 50, {{-.3, 0, 0}, {4.3, 0, 0}, {1, .35, .45}});
}

/// A level with about 100 samples of a pair of tubes.
LevelPair tube_level() {
    return tubes().context().diffusion_level(5);
}

Centres zero_centres(const LevelPair& pair) {
    Centres centres{RowMatrix::Zero(pair.A.side.points.rows(), pair.B.side.points.cols()),
                    RowMatrix::Zero(pair.B.side.points.rows(), pair.A.side.points.cols())};
    pull_landmarks(pair.A.side, pair.B.side, pair.partners, centres);
    return centres;
}

/// What half-steps on a dense support begin from, and change.
struct HalfSteps {
    const LevelPair pair = tube_level();
    const Side &X = pair.A.side, &Y = pair.B.side;
    const Support support = Support::dense(int(X.mass.size()), int(Y.mass.size()));
    Centres centres = zero_centres(pair);
    Coupling plan{support, {}, {}, {}};
    Potentials potentials = Potentials::zero(support.rows(), support.columns());
};

/// gamma sum pi (log(pi / (m n)) - 1).
double entropy(const Side& X, const Side& Y, const Coupling& plan, double gamma) {
    const RowMatrix pi = dense(plan), product = X.mass * Y.mass.transpose();
    return gamma * (pi.array() * ((pi.array().max(1e-300) / product.array()).log() - 1)).sum();
}

TEST(AlternatingMinimization, EachHalfStepLowersWhatItMinimises) {
    HalfSteps state;
    auto& [pair, X, Y, support, centres, plan, potentials] = state;
    double previous = INFINITY, first = 0, gamma = 0;
    for (int round = 0; round < 8; ++round) {
        const Eigen::VectorXd cost = CostFactors(X, Y, centres).on(support);
        if (round == 0) gamma = cost.maxCoeff() / 100;
        sinkhorn({support, cost, X.mass, Y.mass, gamma, 10 * cost.maxCoeff()}, {1e-11, 100000}, potentials,
                 plan);
        const double after_plan = energy(X, Y, plan, centres) + entropy(X, Y, plan, gamma);
        EXPECT_LT(after_plan, previous * (1 + 1e-9));
        const CentreStep step = update_centres(X, Y, plan);
        EXPECT_LT(step.energy, energy(X, Y, plan, centres));
        centres = step.centres;
        previous = step.energy + entropy(X, Y, plan, gamma);
        EXPECT_LT(previous, after_plan);
        if (round == 0) first = step.energy;
    }
    EXPECT_LT(update_centres(X, Y, plan).energy, .9 * first);
}

/// The default energy within bounds: what the bounds allow lowers it, and each half-step what it minimises.
TEST(AlternatingMinimization, EachHalfStepWithinBoundsLowersWhatItMinimises) {
    HalfSteps state;
    auto& [pair, X, Y, support, centres, plan, potentials] = state;
    double previous = INFINITY, gamma = 0;
    for (int round = 0; round < 8; ++round) {
        const Eigen::VectorXd cost = CostFactors(X, Y, centres).on(support);
        if (round == 0) gamma = cost.maxCoeff() / 100;
        sinkhorn({support, cost, X.mass, Y.mass, gamma, 10 * cost.maxCoeff(), MassBounds::around(X.mass, 1.4),
                  MassBounds::around(Y.mass, 1.4)},
                 {1e-11, 100000}, potentials, plan);
        const double after_plan = energy(X, Y, plan, centres) + entropy(X, Y, plan, gamma);
        EXPECT_LT(after_plan, previous * (1 + 1e-9));
        const CentreStep step = update_centres(X, Y, plan);
        EXPECT_LT(step.energy, energy(X, Y, plan, centres));
        centres = step.centres;
        previous = step.energy + entropy(X, Y, plan, gamma);
    }
    EXPECT_GT((row_sums(plan) - X.mass).lpNorm<1>(), 1e-2);
}

/// C' of Sec. 3.4: three half-steps, each lowers C' (the plan's: with its entropy) and keeps Eq. (10).
TEST(AlternatingMinimization, EachHalfStepOfThePaperLowersItsEnergy) {
    constexpr double D = 1.5, slack = 1.1;
    HalfSteps state;
    auto& [pair, X, Y, support, centres, plan, potentials] = state;
    const MassBounds area_X = MassBounds::around(X.mass, D), area_Y = MassBounds::around(Y.mass, D);
    RelaxedMasses relaxed{X.mass, Y.mass};
    double previous = INFINITY, gamma = 0;
    for (int round = 0; round < 8; ++round) {
        const Eigen::VectorXd cost = CostFactors(X, Y, centres, relaxed).on(support);
        if (round == 0) gamma = cost.maxCoeff() / 100;
        sinkhorn({support, cost, X.mass, Y.mass, gamma, 10 * cost.maxCoeff(),
                  area_X.within(MassBounds::around(relaxed.row, slack)),
                  area_Y.within(MassBounds::around(relaxed.column, slack))},
                 {1e-11, 100000}, potentials, plan);
        const double with_plan = energy(X, Y, plan, centres, relaxed);
        EXPECT_LT(with_plan + entropy(X, Y, plan, gamma), previous * (1 + 1e-9));

        const MassBounds around_X = area_X.within(MassBounds::around(row_sums(plan), slack));
        const MassBounds around_Y = area_Y.within(MassBounds::around(column_sums(plan), slack));
        relaxed = update_relaxed_masses(X, Y, plan, centres, {around_X, around_Y});
        EXPECT_NEAR(relaxed.row.sum(), 1, 1e-10);
        EXPECT_NEAR(relaxed.column.sum(), 1, 1e-10);
        EXPECT_LT(std::max(around_X.excess(relaxed.row), around_Y.excess(relaxed.column)), 1e-10);
        const double with_masses = energy(X, Y, plan, centres, relaxed);
        EXPECT_LT(with_masses, with_plan);

        const CentreStep step = update_centres(X, Y, plan, relaxed);
        EXPECT_LT(step.energy, with_masses);
        centres = step.centres;
        previous = step.energy + entropy(X, Y, plan, gamma);
    }
    EXPECT_GT((relaxed.row - X.mass).lpNorm<1>(), 1e-2);
}

TEST(AlternatingMinimization, TightStepKeepsTheAreaBound) {
    const LevelPair pair = tube_level();
    const Side &X = pair.A.side, &Y = pair.B.side;
    for (const AreaEnergy energy : {AreaEnergy::transported, AreaEnergy::paper})
        for (const double bound : {1., 1.2, 4.}) {
            AlternationOptions options;
            options.area_bound = bound;
            options.area_energy = energy;
            options.mass_penalty = 0;
            AlternatingMinimization minimization(X, Y, options, pair.partners);
            minimization.start(zero_centres(pair), {});
            for (int i = 0; i < 3; ++i) minimization.step();
            const double before = minimization.solution().step.energy;
            const double after = minimization.tight_step().energy;
            const double D = std::sqrt(bound);
            const Coupling& plan = minimization.solution().plan;
            EXPECT_LT(MassBounds::around(X.mass, D).excess(row_sums(plan)), 1e-3) << bound << name_of(energy);
            EXPECT_LT(MassBounds::around(Y.mass, D).excess(column_sums(plan)), 1e-3)
                << bound << name_of(energy);
            EXPECT_LT(std::abs(after - before), .1 * before);
        }
}

TEST(AlternatingMinimization, RefusesAPlanThatDoesNotConverge) {
    const LevelPair pair = tube_level();
    AlternationOptions options;
    options.sinkhorn_iterations = 1;
    AlternatingMinimization minimization(pair.A.side, pair.B.side, options, pair.partners);
    minimization.start(zero_centres(pair), {});
    EXPECT_THROW(minimization.tight_step(), ConvergenceError);
}

TEST(AlternatingMinimization, RunsUntilTheEnergySettles) {
    const LevelPair pair = tube_level();
    AlternationOptions options;
    options.maximum_alternations = 100;
    options.area_bound = 1;
    AlternatingMinimization minimization(pair.A.side, pair.B.side, options, pair.partners);
    minimization.start(zero_centres(pair), {});
    std::vector<Alternation> steps;
    minimization.run([&](const Alternation& step) { steps.push_back(step); });
    ASSERT_GT(steps.size(), 2u);
    ASSERT_LT(steps.size(), 100u);
    for (std::size_t i = 1; i < steps.size(); ++i) {
        const double change = std::abs(steps[i].energy - steps[i - 1].energy) / steps[i - 1].energy;
        EXPECT_EQ(change <= options.tolerance, i + 1 == steps.size());
        EXPECT_LE(steps[i].sinkhorn.marginal_error, options.marginal_tolerance);
    }
    const Solution& solution = minimization.solution();
    EXPECT_EQ(steps.back().energy, solution.step.energy);
    EXPECT_EQ(steps.back().entries, solution.plan.support.entries());
    EXPECT_LT((row_sums(solution.plan) - pair.A.side.mass).lpNorm<1>(), options.marginal_tolerance * 1.01);
    EXPECT_LT((column_sums(solution.plan) - pair.B.side.mass).lpNorm<1>(), 1e-9);
}

TEST(AlternatingMinimization, AnnealsGammaToAShareOfTheLargestCost) {
    const LevelPair pair = tube_level();
    AlternatingMinimization minimization(pair.A.side, pair.B.side, {}, pair.partners);
    minimization.start(zero_centres(pair), {});
    const Centres centres = minimization.solution().step.centres;
    const double largest =
        CostFactors(pair.A.side, pair.B.side, centres).on(minimization.solution().plan.support).maxCoeff();
    EXPECT_NEAR(minimization.step().gamma, largest / 300, 1e-12 * largest);
}

TEST(AlternatingMinimization, KeepsLandmarksPinned) {
    const shapes::KnownPair tube = tubes();
    const LevelPair pair = tube.context().diffusion_level(5);
    AlternatingMinimization minimization(pair.A.side, pair.B.side, {}, pair.partners);
    minimization.start(zero_centres(pair), {});
    for (int i = 0; i < 3; ++i) {
        minimization.step();
        for (const auto& [a, b] : tube.landmarks) {
            const int k = pair.A.level.cell[std::size_t(a.index)],
                      l = pair.B.level.cell[std::size_t(b.index)];
            EXPECT_EQ(minimization.solution().step.centres.row.row(k), pair.B.vertex_points.row(b.index));
            EXPECT_EQ(minimization.solution().step.centres.column.row(l), pair.A.vertex_points.row(a.index));
        }
    }
}

TEST(AlternatingMinimization, FindsTheSameOnASupportThatFollowsThePlan) {
    const LevelPair pair = tubes().context().diffusion_level(6);
    const auto solve = [&](double threshold) {
        AlternationOptions options;
        options.support_threshold = threshold;
        AlternatingMinimization minimization(pair.A.side, pair.B.side, options, pair.partners);
        minimization.start(zero_centres(pair), {});
        minimization.run([](const Alternation&) {});
        return minimization.take_solution();
    };
    const Solution sparse = solve(1e-2), full = solve(0);
    ASSERT_GT(full.plan.support.entries(), 10000);
    EXPECT_EQ(full.plan.support.entries(), full.plan.support.rows() * full.plan.support.columns());
    EXPECT_LT(sparse.plan.support.entries(), full.plan.support.entries() * 2 / 3);
    EXPECT_NEAR(sparse.step.energy / full.step.energy, 1, .05);
    EXPECT_LT((sparse.plan.row_background * sparse.plan.column_background.transpose()).sum(), 1e-3);
}

TEST(AlternatingMinimization, DampsSamplesAsLongAsItIsTold) {
    const LevelPair pair = tube_level();
    const Eigen::VectorXd full_X = Eigen::VectorXd::Ones(pair.A.side.mass.size()),
                          full_Y = Eigen::VectorXd::Ones(pair.B.side.mass.size());
    Damping damping{full_X, full_Y};
    damping.row.head(20).setConstant(.01);
    const auto energies = [&](const std::optional<Damping>& first, const std::optional<Damping>& second) {
        AlternatingMinimization minimization(pair.A.side, pair.B.side, {}, pair.partners);
        minimization.start(zero_start(pair).centres, {});
        minimization.set_damping(first);
        const double after_first = minimization.step().energy;
        minimization.set_damping(second);
        return std::pair(after_first, minimization.step().energy);
    };
    const auto plain = energies({}, {}), damped = energies(damping, {}), both = energies(damping, damping);
    EXPECT_NE(damped.first, plain.first);
    EXPECT_EQ(both.first, damped.first);
    EXPECT_NE(both.second, damped.second);
    EXPECT_EQ(energies(Damping{full_X, full_Y}, {}), plain);
}

TEST(AlternatingMinimization, LeavesNeighbourhoodsOfWhichAllIsDampedAway) {
    const LevelPair pair = tube_level();
    Damping damping{Eigen::VectorXd::Ones(pair.A.side.mass.size()),
                    Eigen::VectorXd::Ones(pair.B.side.mass.size())};
    const SparseMatrix& weights = pair.A.side.weights;
    for (SparseMatrix::InnerIterator it(weights, 0); it; ++it) damping.row[it.col()] = 0;
    AlternatingMinimization minimization(pair.A.side, pair.B.side, {}, pair.partners);
    minimization.start(zero_start(pair).centres, {});
    minimization.set_damping(damping);
    for (int i = 0; i < 2; ++i) EXPECT_GT(minimization.step().energy, 0);
    EXPECT_TRUE(minimization.solution().step.centres.row.allFinite());
}

TEST(AlternatingMinimization, RefusesCostsThatAreNoNumbers) {
    LevelPair pair = tube_level();
    pair.A.side.points *= 1e200;
    AlternatingMinimization minimization(pair.A.side, pair.B.side, {}, pair.partners);
    minimization.start(zero_centres(pair), {});
    EXPECT_THROW(minimization.step(), ConvergenceError);
}

TEST(AlternatingMinimization, KeepsTheIdentity) {
    const shapes::KnownPair tube = tubes();
    const LevelPair pair = PairContext(tube.A, tube.A, {}).diffusion_level(6);
    AlternatingMinimization minimization(pair.A.side, pair.B.side, {}, pair.partners);
    minimization.start(
        {pair.A.side.averaging.P * pair.A.side.points, pair.A.side.averaging.P * pair.A.side.points}, {});
    minimization.run([](const Alternation&) {});
    // Nearly all of the mass stays in the neighbourhood it came from.
    EXPECT_GT(dense(minimization.solution().plan).cwiseProduct(RowMatrix(pair.A.side.weights)).sum(), .8);
}

}  // namespace
}  // namespace varimap
