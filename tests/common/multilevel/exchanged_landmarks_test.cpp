#include "varimap/multilevel/exchanged_landmarks.h"

#include <gtest/gtest.h>

#include "fixtures/known_pair.h"

namespace varimap {
namespace {

/// Two bent tubes with landmarks along one side, at uneven distances.
struct TubePair {
    shapes::KnownPair pair =
        shapes::known_pair(shapes::tube(40, 20, true), shapes::tube(36, 18, true, .4), shapes::tube_pose(1),
                           20, {{0, 0, .4}, {.8, 0, .4}, {2, 0, .4}, {3.8, 0, .4}});

    Exchange likely_after(const Exchange& exchange) const {
        return likely_exchange(PairContext(pair.A, pair.B, exchanged(pair.landmarks, exchange)));
    }
};

TEST(ExchangedLandmarks, AreFoundByTheirDistances) {
    const TubePair tubes;
    for (const Exchange& exchange : {Exchange{{0, 1}}, {{1, 3}}, {{0, 2}, {1, 3}}})
        EXPECT_EQ(tubes.likely_after(exchange), exchange);
}

TEST(ExchangedLandmarks, AreNoneWhereAnyExchangeChangesDistances) {
    EXPECT_TRUE(TubePair().likely_after({}).empty());
}

TEST(ExchangedLandmarks, AreNotLookedForAmongOneOrManyLandmarks) {
    TubePair tubes;
    const auto landmarks = tubes.pair.landmarks;
    tubes.pair.landmarks.resize(1);
    EXPECT_TRUE(tubes.likely_after({}).empty());
    // Eleven at three places: to exchange those in one place would change nothing.
    tubes.pair.landmarks.clear();
    for (std::size_t k = 0; k < 11; ++k) tubes.pair.landmarks.push_back(landmarks[k % 3]);
    EXPECT_TRUE(tubes.likely_after({}).empty());
    tubes.pair.landmarks.pop_back();
    EXPECT_FALSE(tubes.likely_after({}).empty());
}

TEST(ExchangedLandmarks, OtherLandmarksFitByTheirDistances) {
    TubePair tubes;
    const auto right = tubes.pair.landmarks, wrong = exchanged(right, {{0, 3}, {1, 2}});
    EXPECT_FALSE(distances_fit(tubes.pair.context(), wrong));
    EXPECT_FALSE(distances_fit(tubes.pair.context(), right));
    tubes.pair.landmarks = wrong;
    EXPECT_TRUE(distances_fit(tubes.pair.context(), right));
    EXPECT_FALSE(distances_fit(tubes.pair.context(), {right[0], right[1], right[2]}));
}

TEST(ExchangedLandmarks, ExchangedTwiceAreAsTheyWere) {
    const TubePair tubes;
    const Exchange exchange{{0, 2}, {1, 3}};
    const auto once = exchanged(tubes.pair.landmarks, exchange);
    EXPECT_EQ(once[0].first.index, tubes.pair.landmarks[0].first.index);
    EXPECT_EQ(once[0].second.index, tubes.pair.landmarks[2].second.index);
    const auto twice = exchanged(once, exchange);
    for (std::size_t k = 0; k < twice.size(); ++k)
        EXPECT_EQ(twice[k].second.index, tubes.pair.landmarks[k].second.index);
}

}  // namespace
}  // namespace varimap
