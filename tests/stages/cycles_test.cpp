#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "stages/cycles/choice.h"

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
SampledMap turned(int by, double score) {
    SampledMap map{{}, {}, score};
    for (int i = 0; i < count; ++i) {
        map.there.push_back((i + by) % count);
        map.back.push_back((i - by + count) % count);
    }
    return map;
}

/// All pairs of circles; each has the right map, the identity, and one that is turned by a half; `wrong`
/// pairs have the wrong one first.
std::vector<PairOfMaps> pairs_of(int surfaces, const std::vector<int>& wrong) {
    std::vector<PairOfMaps> pairs;
    for (int a = 0; a < surfaces; ++a)
        for (int b = a + 1; b < surfaces; ++b) {
            const bool bad = std::count(wrong.begin(), wrong.end(), int(pairs.size())) > 0;
            pairs.push_back(
                {a,
                 b,
                 {turned(bad ? count / 2 : 0, 1), turned(bad ? 0 : count / 2, 1 + (bad ? .02 : .1))},
                 bad ? .6 : .9});
        }
    return pairs;
}

TEST(Choice, KeepsFirstMapsWhoseLoopsClose) {
    const Samples samples(5, circle());
    EXPECT_THAT(choose(samples, pairs_of(5, {})), Each(0));
}

TEST(Choice, TakesTheMapsUnderWhichLoopsClose) {
    const Samples samples(5, circle());
    const auto pairs = pairs_of(5, {2, 7});
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

/// Nearly half of the maps are wrong, so that one pair at a time finds no way; the spanning tree of the
/// trusted does.
TEST(Choice, FollowsTheTrustedPairs) {
    const Samples samples(6, circle());
    const std::vector<int> wrong{5, 6, 7, 9, 12, 13};
    const auto pairs = pairs_of(6, wrong);
    const Choice found = choose(samples, pairs);
    for (int p = 0; p < int(pairs.size()); ++p)
        EXPECT_EQ(found[std::size_t(p)], std::count(wrong.begin(), wrong.end(), p)) << "pair " << p;
}

TEST(Choice, ReversedPairsAndTwoSurfacesAreServed) {
    const Samples samples(3, circle());
    std::vector<PairOfMaps> pairs = pairs_of(3, {});
    std::swap(pairs[1].source, pairs[1].target);  // all maps are their own inverses
    EXPECT_THAT(choose(samples, pairs), Each(0));
    EXPECT_EQ(measure_loops(samples, pairs, {0, 0, 0})[0].closed, 1);
    const std::vector<PairOfMaps> alone{pairs[0]};
    EXPECT_THAT(choose(samples, alone), ElementsAre(0));
    EXPECT_EQ(measure_loops(samples, alone, {0})[0].count, 0);
}

}  // namespace
}  // namespace varimap
