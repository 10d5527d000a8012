#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"
#include "stages/cycles/choice.h"
#include "stages/cycles/collection.h"
#include "varimap/results/choice.h"

namespace varimap {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;

constexpr int count = 24;

/// Samples on a circle of unit radius.
Points circle() {
    Points points(count, 3);
    for (int i = 0; i < count; ++i) {
        const double angle = 2 * 3.14159265358979 * i / count;
        points.row(i) << std::cos(angle), std::sin(angle), 0;
    }
    return points;
}

/// Turned by so many samples.
SampledMap turned(int by, double probability) {
    SampledMap map{{}, {}, probability};
    for (int i = 0; i < count; ++i) {
        map.there.push_back((i + by) % count);
        map.back.push_back((i - by + count) % count);
    }
    return map;
}

/// The right map is the identity, the wrong one is turned by a half.
constexpr int wrong_turn = count / 2;

/// All pairs of circles; each has both maps. `wrong` pairs have the wrong one first, which they are less sure
/// of.
std::vector<PairOfMaps> pairs_of(int surfaces, const std::vector<int>& wrong) {
    std::vector<PairOfMaps> pairs;
    for (int a = 0; a < surfaces; ++a)
        for (int b = a + 1; b < surfaces; ++b) {
            const bool bad = std::count(wrong.begin(), wrong.end(), int(pairs.size())) > 0;
            if (bad)
                pairs.push_back({a, b, {turned(wrong_turn, .3), turned(0, .25)}});
            else
                pairs.push_back({a, b, {turned(0, .9), turned(wrong_turn, .02)}});
        }
    return pairs;
}

/// Every pair takes the map that is the identity.
void expect_identities(const Choice& choice, const std::vector<PairOfMaps>& pairs) {
    for (std::size_t p = 0; p < pairs.size(); ++p)
        EXPECT_EQ(pairs[p].maps[std::size_t(choice[p])].there, turned(0, 0).there) << "pair " << p;
}

TEST(Choice, KeepsFirstMapsWhoseLoopsClose) {
    const Samples samples(5, circle());
    auto pairs = pairs_of(5, {});
    EXPECT_THAT(choose(samples, pairs), Each(0));
}

TEST(Choice, TakesTheMapsUnderWhichLoopsClose) {
    const Samples samples(5, circle());
    auto pairs = pairs_of(5, {2, 7});
    Choice expected(pairs.size(), 0);
    expected[2] = expected[7] = 1;
    EXPECT_EQ(choose(samples, pairs), expected);
    const auto before = measure_loops(samples, pairs, Choice(pairs.size(), 0));
    const auto after = measure_loops(samples, pairs, expected);
    EXPECT_EQ(before[2].count, 3);
    EXPECT_LT(before[2].closed, 3);
    EXPECT_GT(before[2].error, 1);
    EXPECT_EQ(after[2].closed, 3);
    EXPECT_EQ(after[2].error, 0);
}

/// Most maps of surface 3 are wrong; the two that are right know it.
TEST(Choice, FollowsThePairsThatAreSurer) {
    const Samples samples(6, circle());
    auto pairs = pairs_of(6, {5, 6, 9, 12});
    expect_identities(choose(samples, pairs), pairs);
}

/// Two of seven surfaces are turned against the others in seven of ten pairs, so that more loops close where
/// they stay turned; but the three other pairs know.
TEST(Choice, IsNoMatterOfMajorities) {
    const Samples samples(7, circle());
    auto pairs = pairs_of(7, {});
    int across = 0;
    for (PairOfMaps& pair : pairs)
        if (pair.source < 5 && pair.target >= 5)
            pair.maps = ++across <= 7 ? std::vector{turned(wrong_turn, .3), turned(0, .25)}
                                      : std::vector{turned(0, .95), turned(wrong_turn, .01)};
    expect_identities(choose(samples, pairs), pairs);
}

/// Over four surfaces there are two ways for a pair.
TEST(Choice, LeavesSurePairsAlone) {
    const Samples samples(4, circle());
    auto pairs = pairs_of(4, {2});
    pairs[2].sure = true;
    EXPECT_THAT(choose(samples, pairs), Each(0));
    pairs[2].sure = false;
    expect_identities(choose(samples, pairs), pairs);
}

/// With six surfaces four ways over third ones say otherwise, whether or not the pair has that map.
TEST(Choice, OverrulesASurePairWhereManyWaysSpeakAgainstIt) {
    for (const bool has_right : {true, false}) {
        const Samples samples(6, circle());
        auto pairs = pairs_of(6, {});
        pairs[2].maps = {turned(wrong_turn, .9), turned(has_right ? 0 : wrong_turn - 3, .05)};
        pairs[2].sure = true;
        expect_identities(choose(samples, pairs), pairs);
        for (std::size_t p = 0; p < pairs.size(); ++p)
            if (p != 2) pairs[p].maps = {turned(0, .6), turned(wrong_turn, .3)};
        EXPECT_EQ(choose(samples, pairs)[2], 0);  // .6 * .6 * 4 ways are not enough
    }
}

/// What the layout says is one more map where the ways over third surfaces are more probable than the pair's
/// own first.
TEST(Choice, AddsAComposedMapWhereNoneFits) {
    for (const double probability : {.1, .6}) {
        const Samples samples(3, circle());
        auto pairs = pairs_of(3, {});
        for (const std::size_t other : {1, 2}) pairs[other].maps = {turned(0, .7), turned(wrong_turn, .1)};
        pairs[0].maps = {turned(wrong_turn, probability), turned(wrong_turn - 3, .05)};
        const bool added = probability < .7 * .7;
        const Choice choice = choose(samples, pairs);
        EXPECT_EQ(choice[0], added ? 2 : 0);
        ASSERT_EQ(pairs[0].maps.size(), added ? 3u : 2u);
        if (!added) continue;
        EXPECT_EQ(pairs[0].maps[2].there, turned(0, 0).there);
        EXPECT_EQ(measure_loops(samples, pairs, choice)[0].closed, 1);
    }
}

TEST(Choice, ReversedPairsAndTwoSurfacesAreServed) {
    const Samples samples(3, circle());
    std::vector<PairOfMaps> pairs = pairs_of(3, {});
    std::swap(pairs[1].source, pairs[1].target);  // all maps are their own inverses
    EXPECT_THAT(choose(samples, pairs), Each(0));
    EXPECT_EQ(measure_loops(samples, pairs, {0, 0, 0})[0].closed, 1);
    std::vector<PairOfMaps> alone{pairs[0]};
    EXPECT_THAT(choose(samples, alone), ElementsAre(0));
    EXPECT_EQ(measure_loops(samples, alone, {0})[0].count, 0);
}

TEST(Choice, SurfacesOfNoPairAreLeftAlone) {
    Samples samples(3, circle());
    samples.emplace_back();  // no map says what its samples are
    std::vector<PairOfMaps> pairs = pairs_of(3, {});
    EXPECT_THAT(choose(samples, pairs), Each(0));
}

/// The source has more vertices than samples: each vertex goes where the sample nearest to it goes.
TEST(OnFiles, VerticesGoWhereTheNearestSampleGoes) {
    Surface source = shapes::plain_surface(shapes::ellipsoid(2, {3, 2, 1}));
    const Surface target = shapes::plain_surface(shapes::ellipsoid(1, {1, 2, 3}));
    source.on_input.resize(42);  // the first vertices are those of the coarser one
    SampledMap map;
    for (int i = 0; i < 42; ++i) map.there.push_back(41 - i);
    const PointMap images = on_files(map, source, target);
    ASSERT_EQ(images.size(), std::size_t(source.input.vertex_count()));
    for (int v = 0; v < source.input.vertex_count(); ++v) {
        int near = 0;
        for (int i = 1; i < 42; ++i)
            if ((source.input.vertex(i) - source.input.vertex(v)).norm() <
                (source.input.vertex(near) - source.input.vertex(v)).norm())
                near = i;
        EXPECT_LT((position(target.input, images[std::size_t(v)]) - target.input.vertex(41 - near)).norm(),
                  1e-12)
            << "vertex " << v;
    }
}

/// Those of all maps and of none of them are one; what is as good as the first is as probable.
TEST(Probabilities, AreSharedByScore) {
    Candidate good;
    good.relief = .9;
    good.score = 1;
    Candidate worse = good, mirrored = good;
    worse.score = 4;
    mirrored.reversed_mass = .9;
    const auto p = probabilities({good, good, worse, mirrored}, {0, 1, 2, 3});
    EXPECT_EQ(p[0], p[1]);
    EXPECT_LT(p[2], p[0] / 2);
    EXPECT_GT(p[2], 0.05);  // scores mislead now and then
    EXPECT_EQ(p[3], 0);
    EXPECT_NEAR(p[0] + p[1] + p[2], plausibility(good), 1e-12);
}

/// What was found twice is no more probable for it.
TEST(Probabilities, AreThoseOfKinds) {
    Candidate good, other;
    good.relief = other.relief = .9;
    good.score = 1;
    other.score = 2;
    const auto twice = probabilities({good, good, other}, {0, 0, 2}),
               once = probabilities({good, other}, {0, 1});
    EXPECT_NEAR(twice[0] + twice[1], once[0], 1e-12);
    EXPECT_NEAR(twice[2], once[1], 1e-12);
}

TEST(Kinds, AreOfMapsThatAreHardlyElsewhere) {
    std::vector<SampledMap> maps{turned(0, .1), turned(wrong_turn, .1), turned(0, .1),
                                 turned(wrong_turn, .1)};
    std::swap(maps[2].there[0], maps[2].there[1]);
    EXPECT_THAT(kinds(maps, circle()), ElementsAre(0, 1, 0, 1));
}

}  // namespace
}  // namespace varimap
