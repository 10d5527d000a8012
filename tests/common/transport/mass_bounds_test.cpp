#include "varimap/transport/mass_bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fixtures/random_plan.h"

namespace varimap {
namespace {

using random_plan::Generator;

/// clamp(phi a, lower, upper) with phi found by halving an interval of its logarithm.
Eigen::VectorXd by_halving(const Eigen::ArrayXd& log_a, const MassBounds& bounds) {
    const auto masses = [&](double log_phi) {
        Eigen::VectorXd m(log_a.size());
        for (Eigen::Index i = 0; i < m.size(); ++i) {
            const double log_m =
                std::clamp(log_a[i] + log_phi, std::log(bounds.lower[i]), std::log(bounds.upper[i]));
            m[i] = std::exp(log_m);
        }
        return m;
    };
    double low = -1e4, high = 1e4;
    for (int i = 0; i < 200; ++i) {
        const double middle = (low + high) / 2;
        (masses(middle).sum() < 1 ? low : high) = middle;
    }
    return masses(high);
}

TEST(BoundedMasses, AgreeWithASearchByHalving) {
    Generator random(1);
    for (const double spread : {.1, 5., 500.})
        for (const double factor : {1.001, 1.01, 1.5, 10.})
            for (const double shift : {0., 40., -3.}) {  // at phi = 1 all or none are at a bound, or some
                const MassBounds bounds = MassBounds::around(random.mass(60), factor);
                const Eigen::ArrayXd log_a = spread * random.points(60, 1).array() + shift;
                const Eigen::VectorXd m = bounded_masses(log_a, bounds);
                EXPECT_LT((m - by_halving(log_a, bounds)).lpNorm<1>(), 1e-10) << spread << " " << factor;
                EXPECT_NEAR(m.sum(), 1, 1e-12);
                EXPECT_LE(bounds.excess(m), 1e-12);
            }
}

/// sum p (log(p / q) - 1).
double divergence(const Eigen::VectorXd& p, const Eigen::VectorXd& q) {
    return (p.array() * ((p.array() / q.array()).log() - 1)).sum();
}

TEST(BoundedMasses, AreTheProjectionInTheSenseOfKL) {
    Generator random(2);
    const MassBounds bounds = MassBounds::around(random.mass(15), 1.6);
    const Eigen::VectorXd carried = 3 * random.mass(15);
    const Eigen::VectorXd nearest = bounds.projected(carried);
    int compared = 0;
    for (int trial = 0; trial < 4000; ++trial) {
        // Moves some mass from one line to another, if the bounds allow it.
        Eigen::VectorXd other = nearest;
        const auto from = Eigen::Index(15 * random.uniform()), to = Eigen::Index(15 * random.uniform());
        const double moved = .02 * random.uniform();
        other[from] -= moved, other[to] += moved;
        if (from == to || bounds.excess(other) > 0) continue;
        ++compared;
        EXPECT_GT(divergence(other, carried), divergence(nearest, carried));
    }
    EXPECT_GT(compared, 100);
}

TEST(BoundedMasses, KeepSmallMassesBesideLargeOnes) {
    // A running sum over the sorted breakpoints would lose the last two behind e^80.
    const Eigen::ArrayXd log_a = Eigen::Array4d(80, 0, -40, -40 + std::log(3));
    const MassBounds bounds{Eigen::Vector4d(.1, .1, 1e-3, 1e-3), Eigen::Vector4d(.2, .2, .9, .9)};
    const Eigen::VectorXd m = bounded_masses(log_a, bounds);
    EXPECT_NEAR(m[0], .2, 1e-14);
    EXPECT_NEAR(m[1], .2, 1e-14);
    EXPECT_NEAR(m[2], .15, 1e-12);
    EXPECT_NEAR(m[3], .45, 1e-12);
}

TEST(BoundedMasses, TakeTheEndOfBoundsThatLeaveNoChoice) {
    const Eigen::Vector3d low(.5, .3, .2), high(.6, .7, .8);
    const Eigen::Array3d log_a(1, 2, 3);
    EXPECT_LT((bounded_masses(log_a, {low, high}) - low).norm(), 1e-12);
    EXPECT_LT((bounded_masses(log_a, {low / 2, low}) - low).norm(), 1e-12);
}

TEST(MassBounds, MeasureTheirExcess) {
    const Eigen::Vector2d mass(.4, .6);
    const MassBounds bounds = MassBounds::around(mass, 2);
    EXPECT_EQ(bounds.excess(mass), 0);
    EXPECT_EQ(bounds.excess(Eigen::Vector2d(.8, .3)), 0);
    EXPECT_NEAR(bounds.excess(Eigen::Vector2d(.88, .3)), .1, 1e-12);
    EXPECT_NEAR(bounds.excess(Eigen::Vector2d(.8, .24)), .25, 1e-12);
    EXPECT_FALSE(bounds.exact());
    EXPECT_TRUE(MassBounds::around(mass, 1).exact());
    const MassBounds both = bounds.within(MassBounds::around(Eigen::Vector2d(.8, .6), 1.5));
    EXPECT_NEAR(both.lower[0], .8 / 1.5, 1e-15);
    EXPECT_NEAR(both.upper[0], .8, 1e-15);
}

}  // namespace
}  // namespace varimap
