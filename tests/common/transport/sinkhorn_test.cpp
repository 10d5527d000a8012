#include "varimap/transport/sinkhorn.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "fixtures/random_plan.h"

namespace varimap {
namespace {

using random_plan::dense;
using random_plan::Generator;

/// A transport problem that owns what it refers to, and its solution.
struct Matching {
    Support support;
    Eigen::VectorXd cost, row_mass, column_mass;
    double gamma = 1, background_cost = 10, mass_penalty = 0;
    double factor = 1;  ///< of the bounds around the masses; 1: exactly the masses
    Potentials potentials;
    Coupling plan;

    TransportProblem problem() const {
        return {support,         cost,         row_mass,        column_mass, gamma,
                background_cost, row_bounds(), column_bounds(), mass_penalty};
    }

    template <class Method>
    SinkhornReport solve_with(const Method& method, double tolerance, int iterations) {
        potentials = Potentials::zero(support.rows(), support.columns());
        plan.support = support;
        return method(problem(), {tolerance, iterations}, potentials, plan);
    }
    SinkhornReport solve(double tolerance = 1e-12, int iterations = 100000) {
        return solve_with(sinkhorn, tolerance, iterations);
    }
    SinkhornReport solve_in_log_domain(double tolerance = 1e-12, int iterations = 100000) {
        return solve_with(sinkhorn_log_domain, tolerance, iterations);
    }
    MassBounds row_bounds() const { return MassBounds::around(row_mass, factor); }
    MassBounds column_bounds() const { return MassBounds::around(column_mass, factor); }
    RowMatrix full_cost() const { return dense(support, cost, background_cost); }
    RowMatrix product_measure() const { return row_mass * column_mass.transpose(); }
    /// <pi, c> + gamma KL + rho KL of each marginal.
    double objective(const RowMatrix& pi) const {
        const double transport = pi.cwiseProduct(full_cost()).sum() +
                                 gamma * divergence(pi.reshaped(), product_measure().reshaped());
        return transport + mass_penalty * (divergence(pi.rowwise().sum(), row_mass) +
                                           divergence(pi.colwise().sum().transpose(), column_mass));
    }
    /// sum p (log(p / q) - 1).
    static double divergence(const Eigen::VectorXd& p, const Eigen::VectorXd& q) {
        return (p.array() * ((p.array() / q.array()).log() - 1)).sum();
    }
};

Matching random_matching(int rows, int columns, double share, double gamma, unsigned seed) {
    Generator random(seed);
    Matching e;
    e.support = share < 1 ? random.support(rows, columns, share) : Support::dense(rows, columns);
    e.cost = random.values(e.support.entries());
    e.row_mass = random.mass(rows);
    e.column_mass = random.mass(columns);
    e.gamma = gamma;
    return e;
}

void expect_marginals(const Matching& e, double tolerance) {
    EXPECT_LT((row_sums(e.plan) - e.row_mass).lpNorm<1>(), tolerance);
    EXPECT_LT((column_sums(e.plan) - e.column_mass).lpNorm<1>(), tolerance);
}

/// The plan as the potentials state it.
RowMatrix plan_of_potentials(const Matching& e) {
    const RowMatrix sum = e.potentials.row.replicate(1, e.support.columns()) +
                          e.potentials.column.transpose().replicate(e.support.rows(), 1) - e.full_cost();
    return e.product_measure().array() * (sum.array() / e.gamma).exp();
}

TEST(Sinkhorn, MeetsTheMarginalsAndItsPotentials) {
    for (const double share : {.1, 1.}) {
        Matching e = random_matching(40, 30, share, .1, 1);
        const SinkhornReport report = e.solve();
        EXPECT_LE(report.marginal_error, 1e-12);
        expect_marginals(e, 1e-11);
        EXPECT_GE(dense(e.plan).minCoeff(), 0);
        EXPECT_LT((dense(e.plan) - plan_of_potentials(e)).cwiseAbs().maxCoeff(), 1e-12);
    }
}

TEST(Sinkhorn, MinimisesTheRegularisedCost) {
    Matching e = random_matching(12, 10, .4, .2, 2);
    e.background_cost = 1.5;
    e.solve();
    const RowMatrix pi = dense(e.plan);
    const double least = e.objective(pi);
    Generator random(3);
    for (int trial = 0; trial < 20; ++trial) {
        // A step that keeps the marginals: random signs on a rectangle of entries.
        RowMatrix step = random.points(12, 1) * random.points(1, 10);
        step = step.rowwise() - Eigen::RowVectorXd(step.colwise().mean());
        step = step.colwise() - Eigen::VectorXd(step.rowwise().mean());
        const RowMatrix other = pi + .3 * pi.minCoeff() / step.cwiseAbs().maxCoeff() * step;
        EXPECT_GT(e.objective(other), least);
    }
}

TEST(Sinkhorn, AgreesWithTheLogDomainForLargeAndSmallGamma) {
    for (const double gamma : {10., .1, .01, 1e-3}) {
        Matching a = random_matching(30, 36, .3, gamma, 4), b = a;
        const SinkhornReport fast = a.solve(1e-7), reference = b.solve_in_log_domain(1e-7);
        EXPECT_NEAR(fast.iterations, reference.iterations, 1 + reference.iterations / 20) << gamma;
        EXPECT_LT((dense(a.plan) - dense(b.plan)).lpNorm<1>(), 1e-6) << gamma;
    }
}

TEST(Sinkhorn, IteratesLikeTheLogDomain) {
    for (const double gamma : {1., .01, 1e-4}) {
        Matching a = random_matching(25, 25, .3, gamma, 5), b = a;
        const SinkhornReport fast = a.solve(0, 37), reference = b.solve_in_log_domain(0, 37);
        EXPECT_EQ(fast.iterations, reference.iterations);
        EXPECT_NEAR(fast.marginal_error, reference.marginal_error, 1e-9);
        EXPECT_LT((dense(a.plan) - dense(b.plan)).lpNorm<1>(), 1e-9) << gamma;
        EXPECT_LT((a.potentials.row - b.potentials.row).cwiseAbs().maxCoeff(), 1e-8);
        EXPECT_LT((column_sums(a.plan) - a.column_mass).lpNorm<1>(), 1e-12);
    }
}

TEST(Sinkhorn, BackgroundStandsForACostlyRestOfTheMatrix) {
    for (const double gamma : {1., .1}) {
        Matching sparse = random_matching(20, 25, .15, gamma, 6);
        sparse.background_cost = 2;
        Matching full = sparse;
        full.support = Support::dense(20, 25);
        full.cost = Eigen::Map<const Eigen::VectorXd>(sparse.full_cost().eval().data(), 500);
        full.background_cost = 5;
        sparse.solve();
        full.solve();
        EXPECT_LT((dense(sparse.plan) - dense(full.plan)).cwiseAbs().maxCoeff(), 1e-11);
        EXPECT_GT((sparse.plan.row_background * sparse.plan.column_background.transpose()).sum(), 1e-9);
    }
}

TEST(Sinkhorn, BackgroundCarriesWhatTheSupportCannot) {
    Matching e;
    e.support = Support({{0}, {0}, {}, {1, 2}}, 4);  // too much for column 0; nothing for row 2 and column 3
    e.cost = Eigen::VectorXd::Constant(4, .5);
    e.row_mass = e.column_mass = Eigen::VectorXd::Constant(4, .25);
    for (const double gamma : {.5, 1e-2, 3e-3}) {
        e.gamma = gamma;
        EXPECT_LE(e.solve(1e-9).marginal_error, 1e-9) << gamma;
        expect_marginals(e, 1e-8);
        EXPECT_TRUE(e.potentials.row.allFinite() && e.potentials.column.allFinite());
    }
}

TEST(Sinkhorn, StaysFiniteForExtremeCosts) {
    Matching e = random_matching(50, 40, .2, 1, 7);
    Generator random(8);
    for (double& c : e.cost) c = std::pow(10, 12 * random.uniform() - 6);
    e.gamma = e.cost.maxCoeff() / 1e4;
    e.background_cost = 10 * e.cost.maxCoeff();
    const SinkhornReport report = e.solve(1e-6, 3000);
    EXPECT_TRUE(dense(e.plan).allFinite());
    EXPECT_TRUE(e.potentials.row.allFinite() && e.potentials.column.allFinite());
    EXPECT_LT((column_sums(e.plan) - e.column_mass).lpNorm<1>(), 1e-9);
    EXPECT_NEAR((row_sums(e.plan) - e.row_mass).lpNorm<1>(), report.marginal_error, 1e-9);
    EXPECT_LT(report.marginal_error, .1);
}

/// The share of a step that keeps a plan positive and its marginals within the bounds.
double feasible_share(const Matching& e, const RowMatrix& pi, const RowMatrix& step) {
    double share = .3 * (pi.array() / step.array().abs()).minCoeff();
    const auto keep = [&](const Eigen::VectorXd& sum, const Eigen::VectorXd& change,
                          const MassBounds& bounds) {
        for (Eigen::Index i = 0; i < sum.size(); ++i) {
            const double room =
                std::max(0.0, change[i] > 0 ? bounds.upper[i] - sum[i] : sum[i] - bounds.lower[i]);
            if (change[i] != 0) share = std::min(share, room / std::abs(change[i]));
        }
    };
    keep(pi.rowwise().sum(), step.rowwise().sum(), e.row_bounds());
    keep(pi.colwise().sum().transpose(), step.colwise().sum().transpose(), e.column_bounds());
    return share;
}

TEST(Sinkhorn, BoundedMinimisesItsObjectiveWithinTheBounds) {
    for (const double penalty : {0., .05, 1.}) {
        Matching e = random_matching(12, 10, .4, .2, 13);
        e.background_cost = 1.5;
        e.factor = 1.3;
        e.mass_penalty = penalty;
        e.solve();
        const RowMatrix pi = dense(e.plan);
        EXPECT_NEAR(pi.sum(), 1, 1e-10);
        EXPECT_LT(e.row_bounds().excess(pi.rowwise().sum()), 1e-9);
        EXPECT_LT(e.column_bounds().excess(pi.colwise().sum().transpose()), 1e-9);
        EXPECT_GT((pi.rowwise().sum() - e.row_mass).lpNorm<1>(), 1e-3);
        Generator random(14);
        int compared = 0;
        for (int trial = 0; trial < 3000; ++trial) {
            // A little mass moves from one entry to another.
            RowMatrix step = RowMatrix::Zero(12, 10);
            step(int(12 * random.uniform()), int(10 * random.uniform())) += 1;
            step(int(12 * random.uniform()), int(10 * random.uniform())) -= 1;
            const double share = feasible_share(e, pi, step);
            if (step.isZero() || share < 1e-5) continue;
            ++compared;
            EXPECT_GT(e.objective(pi + share * step), e.objective(pi));
        }
        EXPECT_GT(compared, 100);
    }
}

TEST(Sinkhorn, BoundedAgreesWithTheLogDomain) {
    for (const double gamma : {1., .05, 2e-3})
        for (const double penalty : {0., .1}) {
            Matching a = random_matching(30, 36, .3, gamma, 16);
            a.factor = 1.2;
            a.mass_penalty = penalty;
            Matching b = a;
            const SinkhornReport fast = a.solve(1e-9), reference = b.solve_in_log_domain(1e-9);
            EXPECT_NEAR(fast.iterations, reference.iterations, 1 + reference.iterations / 20) << gamma;
            EXPECT_LT((dense(a.plan) - dense(b.plan)).lpNorm<1>(), 1e-7) << gamma;
            EXPECT_LT(a.column_bounds().excess(column_sums(a.plan)), 1e-9);
        }
}

TEST(Sinkhorn, BoundsTendToExactMasses) {
    Matching exact = random_matching(20, 20, .3, .1, 15), bounded = exact, penalised = exact;
    bounded.factor = 1 + 1e-6;
    penalised.factor = 1.5;
    penalised.mass_penalty = 1e6;
    exact.solve(1e-10);
    bounded.solve(1e-10);
    penalised.solve(1e-10);
    EXPECT_LT((dense(exact.plan) - dense(bounded.plan)).lpNorm<1>(), 1e-4);
    EXPECT_LT((dense(exact.plan) - dense(penalised.plan)).lpNorm<1>(), 1e-4);
}

/// Row sums carry what the bounds allow where only mass matters: half of the rows are free, half cost 1.
TEST(Sinkhorn, BoundsAreReachedWhereTheyPay) {
    Matching e;
    e.support = Support::dense(4, 4);
    e.row_mass = e.column_mass = Eigen::VectorXd::Constant(4, .25);
    e.cost = Eigen::VectorXd::Zero(16);
    e.cost.tail(8).setOnes();
    e.gamma = 1e-2;
    e.factor = 1.25;
    e.solve();
    const Eigen::VectorXd expected = Eigen::Vector4d(.3, .3, .2, .2);
    EXPECT_LT((row_sums(e.plan) - expected).lpNorm<1>(), 1e-9);
    EXPECT_LT((column_sums(e.plan) - e.column_mass).lpNorm<1>(), 1e-9);
}

TEST(Sinkhorn, RoundingMeetsMassesByMovingWhatTheyWereMissedBy) {
    Matching e = random_matching(30, 25, .3, .05, 17);
    e.solve(5e-2);
    const RowMatrix before = dense(e.plan);
    const double missed = (row_sums(e.plan) - e.row_mass).lpNorm<1>();
    EXPECT_GT(missed, 1e-3);
    round_to_masses(e.row_mass, e.column_mass, e.plan);
    expect_marginals(e, 1e-14);
    EXPECT_GE(dense(e.plan).minCoeff(), 0);
    EXPECT_LT((dense(e.plan) - before).lpNorm<1>(), 2 * missed);
}

TEST(Sinkhorn, TendsToTheSortedMatchingOnALine) {
    constexpr int n = 20;
    Generator random(9);
    Matching e;
    e.support = Support::dense(n, n);
    e.row_mass = e.column_mass = Eigen::VectorXd::Constant(n, 1. / n);
    e.cost.resize(n * n);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) e.cost[i * n + j] = std::pow((i - j + .4) / n, 2);
    e.gamma = 1e-5;
    e.solve(1e-9);
    EXPECT_NEAR(dense(e.plan).trace(), 1, 1e-6);
}

TEST(Sinkhorn, StopsAtOnceWhenItStartsFromTheSolution) {
    Matching e = random_matching(30, 30, .3, .05, 10);
    EXPECT_GT(e.solve(1e-6).iterations, 5);
    EXPECT_EQ(sinkhorn(e.problem(), {1e-6, 1000}, e.potentials, e.plan).iterations, 1);
    EXPECT_EQ(sinkhorn_log_domain(e.problem(), {1e-6, 1000}, e.potentials, e.plan).iterations, 1);
}

TEST(Sinkhorn, IsTheSameToTheLastBitForAnyThreads) {
    Matching a = random_matching(1500, 1400, .01, .02, 11), b = a;
    {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
        a.solve(1e-3);
    }
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 2);
    b.solve(1e-3);
    EXPECT_EQ(a.plan.value, b.plan.value);
    EXPECT_EQ(a.plan.row_background, b.plan.row_background);
    EXPECT_EQ(a.potentials.column, b.potentials.column);
}

}  // namespace
}  // namespace varimap
