#include "stages/explore/starts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "fixtures/explored.h"
#include "fixtures/known_pair.h"
#include "stages/explore/tips.h"

namespace varimap {
namespace {

using shapes::figures;
using shapes::KnownPair;

TEST(Starts, SpectralMatchingsHoldTheTrueOne) {
    // A surface onto itself: among the signs there is the identity.
    KnownPair pair = figures();
    pair.B = pair.A;
    const PairContext context = pair.context();
    const LevelPair level = context.diffusion_level(2);
    const auto matchings = spectral_matchings(context, level);
    EXPECT_EQ(matchings.size(), 16u);
    const auto is_identity = [](const Matching& m) {
        return std::all_of(m.begin(), m.end(), [](auto p) { return p.first == p.second; });
    };
    EXPECT_EQ(std::count_if(matchings.begin(), matchings.end(), is_identity), 1);
}

Tips tips_of(const PairContext& context, bool of_A) {
    const LevelPair level = context.diffusion_level(context.diffusion_levels() - 1);
    return find_tips(of_A ? context.graph_A() : context.graph_B(),
                     of_A ? level.A.level.samples : level.B.level.samples, 8);
}

TEST(Tips, AreTheEndsOfAnEllipsoid) {
    const TriangleMesh mesh = shapes::ellipsoid(3, {.5, .6, 2});
    const GeodesicGraph graph(mesh);
    std::vector<int> all(std::size_t(mesh.vertex_count()));
    std::iota(all.begin(), all.end(), 0);
    const Tips tips = find_tips(graph, all, 8);
    ASSERT_EQ(tips.vertices.size(), 2u);
    double product = 1;
    for (const int tip : tips.vertices) {
        EXPECT_GT(std::abs(mesh.vertex(tip)[2]), 1.8);
        product *= mesh.vertex(tip)[2];
    }
    EXPECT_LT(product, 0);
    EXPECT_EQ(tips.distance(tips.vertices[1], 1), 0);
    EXPECT_TRUE(match_tips(tips, tips, 5).empty());  // two are too few to tell anything
}

TEST(Tips, OfAFigureAndItsPoseAreMatchedRightAmongTheBest) {
    const KnownPair& pair = figures();
    const PairContext context = pair.context();
    const Tips A = tips_of(context, true), B = tips_of(context, false);
    ASSERT_GE(A.vertices.size(), 4u);
    const std::vector<TipMatching> matchings = match_tips(A, B, 32);
    ASSERT_FALSE(matchings.empty());
    ASSERT_LE(matchings.size(), 32u);
    const auto is_right = [&](const TipMatching& tips) {
        return std::all_of(tips.begin(), tips.end(), [&](const auto& match) {
            const Vec3 truth = pair.A_on_B.row(A.vertices[std::size_t(match.first)]).transpose();
            return (pair.B.surface.mesh.vertex(B.vertices[std::size_t(match.second)]) - truth).norm() < .15;
        });
    };
    EXPECT_TRUE(std::any_of(matchings.begin(), matchings.end(), is_right));
    EXPECT_FALSE(std::all_of(matchings.begin(), matchings.end(), is_right));
    EXPECT_TRUE(match_tips(A, B, 0).empty());
}

TEST(Starts, AxesMatchingsHoldTheTrueOneWhateverTheProportions) {
    // A figure turned in space, twice as stout and half as tall: the places of samples tell which is which.
    KnownPair pair = figures();
    pair.B = pair.A;
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(2, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    pair.B.surface.mesh.vertices =
        pair.A.surface.mesh.vertices * Vec3(2, 2, .5).asDiagonal() * turn.transpose();
    const PairContext context = pair.context();
    const LevelPair level = context.diffusion_level(context.diffusion_levels() - 1);
    const auto matchings = axes_matchings(context, level);
    EXPECT_EQ(matchings.size(), 24u);
    const std::vector<int>& samples = level.A.level.samples;
    const TriangleMesh& mesh = pair.A.surface.mesh;
    std::vector<double> errors;
    for (const Matching& m : matchings) {
        double sum = 0;
        for (const auto& [i, j] : m)
            sum += (mesh.vertex(samples[std::size_t(i)]) - mesh.vertex(samples[std::size_t(j)])).norm();
        errors.push_back(sum / double(m.size()));
    }
    std::sort(errors.begin(), errors.end());
    EXPECT_LT(errors[0], .1);
    EXPECT_GT(errors[1], .15);
}

TEST(Starts, RandomMatchingsUseEverySampleAndRepeatForASeed) {
    std::mt19937 random(3), again(3);
    const auto matchings = random_matchings(5, 8, 4, random);
    EXPECT_EQ(matchings, random_matchings(5, 8, 4, again));
    EXPECT_NE(matchings[0], matchings[1]);
    std::set<int> rows, columns;
    for (const auto& [i, j] : matchings[0]) rows.insert(i), columns.insert(j);
    EXPECT_EQ(rows.size(), 5u);
    EXPECT_EQ(columns.size(), 8u);
}

TEST(Starts, SwapsExchangeRowsPairwise) {
    const Coupling plan{Support::dense(3, 2), Eigen::VectorXd::LinSpaced(6, 0, 5), Eigen::VectorXd::Zero(3),
                        Eigen::VectorXd::Zero(2)};
    const auto swapped = with_swapped_rows(plan, 8);
    ASSERT_EQ(swapped.size(), 3u);
    EXPECT_EQ(swapped[1].value, (Eigen::VectorXd(6) << 4, 5, 2, 3, 0, 1).finished());
}

}  // namespace
}  // namespace varimap
