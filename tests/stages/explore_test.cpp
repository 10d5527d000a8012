#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <set>

#include "fixtures/known_pair.h"
#include "stages/diffuse/diffuse.h"
#include "stages/explore/bending_agreement.h"
#include "stages/explore/params.h"
#include "stages/explore/starts.h"

namespace varimap {
namespace {

using shapes::KnownPair;

Candidates explore(const PairContext& context, double distinct = ExploreParams().exploration.distinct) {
    ExploreParams params;
    params.exploration.distinct = distinct;
    return explore(context, params.exploration, params.alternation, params.ironing);
}

const KnownPair& figures() {
    static const KnownPair pair = shapes::figure_pair(1, false);
    return pair;
}

/// The pair with its target reflected in space, which makes it of the other handedness.
KnownPair reflected(KnownPair pair) {
    Surface& B = pair.B.surface;
    B.mesh.vertices.col(1) *= -1;
    B.input.vertices.col(1) *= -1;
    B = with_reversed_orientation(std::move(B));
    pair.A_on_B.col(1) *= -1;
    return pair;
}

TEST(Explore, FindsTheMapOfAFigureOntoItsPose) {
    const PairContext context = figures().context();
    const Candidates found = explore(context);
    EXPECT_LT(mean_error(diffuse(context, {}, found), figures()), .025);
    EXPECT_FALSE(is_mirrored(found.list[0]));
    EXPECT_EQ(found.list[0].moved_mass, 0);
    EXPECT_TRUE(found.previews.empty());  // sure
}

TEST(Explore, RanksRivalsBehindTheMap) {
    // At the usual distance it is a matter of rounding whether this figure's nearest rival is a duplicate.
    const Candidates found = explore(figures().context(), .02);
    ASSERT_GE(found.list.size(), 2u);
    EXPECT_GT(found.list[1].moved_mass, .02);
    EXPECT_GT(found.list[1].score, found.list[0].score);
}

TEST(Explore, MapsOppositeHandednessOnlyWhenMirrored) {
    KnownPair pair = reflected(figures());
    pair.A.surface = with_reversed_orientation(std::move(pair.A.surface));
    const PairContext context = pair.context();
    EXPECT_LT(mean_error(diffuse(context, {}, explore(context)), pair), .025);
    const KnownPair plain = reflected(figures());
    const PairContext plain_context = plain.context();
    EXPECT_GT(mean_error(diffuse(plain_context, {}, explore(plain_context)), plain), .05);
}

TEST(Explore, IsTheSameToTheLastBitForAnyThreads) {
    const PairContext context = figures().context();
    const auto bytes = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return encode(explore(context));
    };
    EXPECT_EQ(bytes(1), bytes(2));
}

TEST(Explore, SumsPlansOverTheCellsOfACoarseLevel) {
    const PairContext context = figures().context();
    const Candidates found = explore(context);
    EXPECT_GE(found.samples_A.size(), 20u);
    EXPECT_LT(found.samples_A.size(), 100u);
    for (const SparseMatrix& plan : found.plans) EXPECT_NEAR(plan.sum(), 1, .05);
}

TEST(Explore, PreviewsMapsWhereItIsNotSure) {
    // Symmetry leaves four maps of an ellipsoid, which keep or reverse coordinates.
    const TriangleMesh mesh = shapes::ellipsoid(3, {1, .7, .5});
    TriangleMesh other = shapes::moved(shapes::ellipsoid(3), 1, 1, Vec3::Zero());  // tessellated otherwise
    other.vertices *= Vec3(1, .7, .5).asDiagonal();
    const Candidates found = explore(shapes::known_pair(mesh, other, {}, 60, {}).context());
    ASSERT_EQ(found.previews.size(), std::min(found.list.size(), size_t(3)));
    for (const PointMap& map : found.previews) {
        ASSERT_EQ(int(map.size()), other.vertex_count());
        double sum = 0;
        for (int v = 0; v < other.vertex_count(); ++v)
            sum += (position(mesh, map[size_t(v)]).cwiseAbs() - other.vertex(v).cwiseAbs()).norm();
        EXPECT_LT(sum / other.vertex_count(), .2);  // a vertex's distance from the next is .1
    }
}

TEST(Bending, AgreesWithItselfAlone) {
    const PairContext context = figures().context();
    const LevelPair pair = context.diffusion_level(6);
    const Eigen::VectorXd& height = context.A().hierarchy.shape.bending;
    Orientation identity, reversed;
    identity.image_vertex = reversed.image_vertex = pair.A.level.samples;
    std::reverse(reversed.image_vertex.begin(), reversed.image_vertex.end());
    const LevelPair self{pair.A, pair.A, {}};
    EXPECT_NEAR(bending_agreement(self, height, height, {identity, identity}), 1, 1e-12);
    EXPECT_LT(bending_agreement(self, height, height, {reversed, reversed}), .5);
}

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

TEST(Confidence, NeedsAMarginAndLevelsThatAgree) {
    Candidate best{.diffusion_energy = 1, .euclidean_energy = 1, .score = 0},
        other{.diffusion_energy = 2, .euclidean_energy = 2, .score = .02};
    EXPECT_TRUE(confidence_of({best, other}).confident);
    EXPECT_NEAR(confidence_of({best, other}).margin, .02, 1e-15);
    other.score = .005;
    EXPECT_FALSE(confidence_of({best, other}).confident);
    other.reversed_mass = .9;  // a mirrored map is no rival
    EXPECT_TRUE(confidence_of({best, other}).confident);
    other = {.diffusion_energy = .9,
             .euclidean_energy = 2,
             .score = .001,
             .moved_mass = .03};  // nor is the same map
    EXPECT_TRUE(confidence_of({best, other}).confident);
    other = {.diffusion_energy = .9, .euclidean_energy = 2, .score = .02};
    EXPECT_FALSE(confidence_of({best, other}).confident);
}

}  // namespace
}  // namespace varimap
