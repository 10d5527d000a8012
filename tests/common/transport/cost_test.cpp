#include "varimap/transport/cost.h"

#include <gtest/gtest.h>

#include <Eigen/QR>

#include "fixtures/random_plan.h"

namespace varimap {
namespace {

using random_plan::dense;
using random_plan::energy;
using random_plan::Generator;

/// Two sides with centres anywhere and a plan with exact marginals.
struct Example {
    Side X, Y;
    Centres centres;
    Coupling plan;
};

Example random_example(unsigned seed, int nx = 14, int ny = 11, int dx = 3, int dy = 4) {
    Generator random(seed);
    Example e{random.side(nx, dx), random.side(ny, dy), {}, {}};
    e.centres = {random.points(nx, dy), random.points(ny, dx)};
    e.plan.support = random.support(nx, ny, .5);
    const Eigen::VectorXd cost = random.values(e.plan.support.entries());
    Potentials potentials = Potentials::zero(nx, ny);
    sinkhorn({e.plan.support, cost, e.X.mass, e.Y.mass, .3, 2}, {1e-14, 10000}, potentials, e.plan);
    return e;
}

/// W_k(x_i) / Z_k, the normalised weighting functions.
RowMatrix normalised_weights(const Side& side) {
    const RowMatrix W = side.weights;
    return (W * side.mass).cwiseInverse().asDiagonal() * W;
}

/// The coefficient of pi_ij in Eq. (3), as the double sum.
double coefficient(const Example& e, int i, int j) {
    const RowMatrix WX = normalised_weights(e.X), WY = normalised_weights(e.Y);
    double sum = 0;
    for (int k = 0; k < WX.rows(); ++k)
        sum += e.X.mass[k] * WX(k, i) * (e.Y.points.row(j) - e.centres.row.row(k)).squaredNorm();
    for (int l = 0; l < WY.rows(); ++l)
        sum += e.Y.mass[l] * WY(l, j) * (e.X.points.row(i) - e.centres.column.row(l)).squaredNorm();
    return sum;
}

/// Eq. (3), summed entry by entry.
double brute_force_energy(const Example& e) {
    const RowMatrix pi = dense(e.plan);
    double sum = 0;
    for (int i = 0; i < pi.rows(); ++i)
        for (int j = 0; j < pi.cols(); ++j) sum += pi(i, j) * coefficient(e, i, j);
    return sum;
}

/// One half of Eq. (1): sum_k m_k var of the images (points y) of the k-th neighbourhood, from pairwise
/// distances.
double variance_of_images(const Side& X, const RowMatrix& pi, const RowMatrix& y) {
    const RowMatrix image = normalised_weights(X) * pi;  // row k: a probability measure on the other side
    double sum = 0;
    for (int k = 0; k < image.rows(); ++k)
        for (int a = 0; a < y.rows(); ++a)
            for (int b = 0; b < a; ++b)
                sum += X.mass[k] * image(k, a) * image(k, b) * (y.row(a) - y.row(b)).squaredNorm();
    return sum;
}

TEST(AveragingOperator, WeighsByMassAndSumsToOne) {
    const Side side = Generator(1).side(12, 2);
    const RowMatrix expected = normalised_weights(side) * side.mass.asDiagonal();
    EXPECT_LT((RowMatrix(side.averaging.P) - expected).cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_LT(
        (side.averaging.P * Eigen::VectorXd::Ones(12) - Eigen::VectorXd::Ones(12)).cwiseAbs().maxCoeff(),
        1e-14);
}

TEST(Cost, CollapsesTheDoubleSum) {
    const Example e = random_example(2);
    const CostFactors factors(e.X, e.Y, e.centres);
    for (int i = 0; i < 14; ++i)
        for (int j = 0; j < 11; ++j) EXPECT_NEAR(factors.entry(i, j), coefficient(e, i, j), 1e-12);
    const Eigen::VectorXd cost = factors.on(e.plan.support);
    for (int i = 0; i < 14; ++i)
        for (int k = e.plan.support.row_begin[i]; k < e.plan.support.row_begin[i + 1]; ++k)
            EXPECT_NEAR(cost[k], coefficient(e, i, e.plan.support.column[k]), 1e-12);
}

TEST(Cost, AddsSquaredDistancesOfDescriptors) {
    Example e = random_example(3);
    Generator random(4);
    e.X.descriptor = random.points(14, 5);
    e.Y.descriptor = random.points(11, 5);
    const CostFactors factors(e.X, e.Y, e.centres);
    for (int i = 0; i < 14; ++i)
        for (int j = 0; j < 11; ++j)
            EXPECT_NEAR(factors.entry(i, j),
                        coefficient(e, i, j) + (e.X.descriptor.row(i) - e.Y.descriptor.row(j)).squaredNorm(),
                        1e-12);
}

TEST(Cost, DoesNotDependOnTheBasisOfAnEmbedding) {
    Example e = random_example(5);
    const CostFactors before(e.X, e.Y, e.centres);
    // A rotation that also reflects: signs of eigenfunctions and bases of multiple eigenvalues.
    Generator random(6);
    const Eigen::MatrixXd Q = Eigen::HouseholderQR<Eigen::MatrixXd>(random.points(4, 4)).householderQ();
    e.Y.points = e.Y.points * Q;
    e.centres.row = e.centres.row * Q;
    e.X.points.col(1) *= -1;
    e.centres.column.col(1) *= -1;
    const CostFactors after(e.X, e.Y, e.centres);
    for (int i = 0; i < 14; ++i)
        for (int j = 0; j < 11; ++j) EXPECT_NEAR(after.entry(i, j), before.entry(i, j), 1e-12);
}

TEST(Cost, IsNeverNegativeOnASupport) {
    Example e = random_example(7);
    e.X.points *= 1e-9;  // all points nearly coincide far from the origin: the terms cancel
    e.X.points.array() += 100;
    e.centres.column.setConstant(100);
    e.Y.points.setConstant(-100);
    e.centres.row.setConstant(-100);
    EXPECT_GE(CostFactors(e.X, e.Y, e.centres).on(Support::dense(14, 11)).minCoeff(), 0);
}

TEST(Energy, IsEquationThree) {
    const Example e = random_example(8);
    EXPECT_NEAR(energy(e.X, e.Y, e.plan, e.centres), brute_force_energy(e), 1e-12);
}

TEST(Energy, IsEquationThreeAlsoWhereMarginalsAreNotExact) {
    Example e = random_example(14);
    e.plan.value = Generator(15).values(e.plan.support.entries()) / 100;
    EXPECT_NEAR(energy(e.X, e.Y, e.plan, e.centres), brute_force_energy(e), 1e-12);
    const CentreStep step = update_centres(e.X, e.Y, e.plan);
    EXPECT_LT(step.energy, energy(e.X, e.Y, e.plan, {step.centres.row.array() + 1e-3, step.centres.column}));
    EXPECT_LT(step.energy, energy(e.X, e.Y, e.plan, {step.centres.row, step.centres.column.array() - 1e-3}));
}

/// C' as the sum over all entries and centres (cost.h).
double brute_force_relaxed_energy(const Example& e, const RelaxedMasses& relaxed) {
    const RowMatrix pi = dense(e.plan), WX = normalised_weights(e.X), WY = normalised_weights(e.Y);
    double sum = 0;
    for (int i = 0; i < pi.rows(); ++i)
        for (int j = 0; j < pi.cols(); ++j) {
            for (int k = 0; k < pi.rows(); ++k)
                sum += e.X.mass[k] * WX(k, i) * e.X.mass[i] / relaxed.row[i] * pi(i, j) *
                       (e.Y.points.row(j) - e.centres.row.row(k)).squaredNorm();
            for (int l = 0; l < pi.cols(); ++l)
                sum += e.Y.mass[l] * WY(l, j) * e.Y.mass[j] / relaxed.column[j] * pi(i, j) *
                       (e.X.points.row(i) - e.centres.column.row(l)).squaredNorm();
        }
    return sum;
}

TEST(Energy, OfRelaxedMassesIsThePapersAndItsHalfStepsAreMinima) {
    Example e = random_example(16);
    Generator random(17);
    const RelaxedMasses relaxed{random.mass(14), random.mass(11)};
    EXPECT_NEAR(energy(e.X, e.Y, e.plan, e.centres, relaxed), brute_force_relaxed_energy(e, relaxed), 1e-11);

    const CentreStep step = update_centres(e.X, e.Y, e.plan, relaxed);
    const MassBounds rows = MassBounds::around(e.X.mass, 1.5), columns = MassBounds::around(e.Y.mass, 1.5);
    const RelaxedMasses best = update_relaxed_masses(e.X, e.Y, e.plan, e.centres, {rows, columns});
    for (int trial = 0; trial < 20; ++trial) {
        const Centres other{step.centres.row + .01 * random.points(14, 4),
                            step.centres.column + .01 * random.points(11, 3)};
        EXPECT_GT(energy(e.X, e.Y, e.plan, other, relaxed), step.energy);
        const RelaxedMasses others{
            rows.projected(best.row.array() * (1 + .1 * random.points(14, 1).array())),
            columns.projected(best.column.array() * (1 + .1 * random.points(11, 1).array()))};
        EXPECT_GT(energy(e.X, e.Y, e.plan, e.centres, others), energy(e.X, e.Y, e.plan, e.centres, best));
    }
}

TEST(Centres, MakeEquationThreeEquationOne) {
    const Example e = random_example(10);
    const RowMatrix pi = dense(e.plan);
    const double variance =
        variance_of_images(e.X, pi, e.Y.points) + variance_of_images(e.Y, pi.transpose(), e.X.points);
    EXPECT_NEAR(update_centres(e.X, e.Y, e.plan).energy, variance, 1e-12);
}

TEST(Centres, MinimiseEquationThree) {
    Example e = random_example(11);
    const CentreStep step = update_centres(e.X, e.Y, e.plan);
    EXPECT_LT(step.energy, energy(e.X, e.Y, e.plan, e.centres));
    e.centres = step.centres;
    EXPECT_NEAR(step.energy, brute_force_energy(e), 1e-12);
    Generator random(12);
    for (int trial = 0; trial < 10; ++trial) {
        const Centres other{step.centres.row + .01 * random.points(14, 4),
                            step.centres.column + .01 * random.points(11, 3)};
        EXPECT_GT(energy(e.X, e.Y, e.plan, other), step.energy);
    }
}

/// One landmark: a sample of X and one of Y.
Partners partners(int i, int j, double weight) {
    Partners one{std::vector<int>(14, -1), std::vector<int>(11, -1), weight};
    one.row[std::size_t(i)] = j;
    one.column[std::size_t(j)] = i;
    return one;
}

TEST(Centres, OfLandmarksAreTheirPartners) {
    Example e = random_example(13);
    const CentreStep step = update_centres(e.X, e.Y, e.plan, {}, partners(5, 2, 1));
    EXPECT_EQ(step.centres.row.row(5), e.Y.points.row(2));
    EXPECT_EQ(step.centres.column.row(2), e.X.points.row(5));
    e.centres = step.centres;
    EXPECT_NEAR(step.energy, brute_force_energy(e), 1e-12);
    const RowMatrix image = dense(e.plan) * e.Y.points;
    EXPECT_LT(
        (step.row_image - RowMatrix(e.X.mass.cwiseInverse().asDiagonal() * image)).cwiseAbs().maxCoeff(),
        1e-11);
}

TEST(Centres, OfSoftLandmarksAreTheBestOnesForThePriceOfDisagreeing) {
    constexpr double W = .3;
    Example e = random_example(14);
    const Centres free = update_centres(e.X, e.Y, e.plan).centres;
    const CentreStep step = update_centres(e.X, e.Y, e.plan, {}, partners(5, 2, W));
    EXPECT_LT((step.centres.row.row(5) - (W * e.Y.points.row(2) + (1 - W) * free.row.row(5))).norm(), 1e-12);
    EXPECT_EQ(step.centres.row.row(4), free.row.row(4));
    const auto energy_with_landmarks = [&](const Centres& centres) {
        return energy(e.X, e.Y, e.plan, centres) +
               W / (1 - W) *
                   (e.X.mass[5] * (centres.row.row(5) - e.Y.points.row(2)).squaredNorm() +
                    e.Y.mass[2] * (centres.column.row(2) - e.X.points.row(5)).squaredNorm());
    };
    EXPECT_NEAR(step.energy, energy_with_landmarks(step.centres), 1e-11);
    for (const double change : {-.01, .01}) {
        Centres changed = step.centres;
        changed.row.row(5) += change * e.Y.points.row(2);
        EXPECT_GT(energy_with_landmarks(changed), step.energy);
    }
}

}  // namespace
}  // namespace varimap
