#include "varimap/results/landmark_check.h"

#include <gtest/gtest.h>

namespace varimap {
namespace {

TEST(LandmarkCheck, NamesTheMostContradictedOne) {
    EXPECT_EQ(contradicted_landmark({}), -1);
    EXPECT_EQ(contradicted_landmark({{.3, .05}, {.8, .1}, {.9, .06}}), 1);
}

TEST(LandmarkCheck, TakesNeitherDistanceNorEnergyAloneForAContradiction) {
    EXPECT_EQ(contradicted_landmark({{.9, .002}, {.05, .05}, {1.2, -.1}}), -1);
}

}  // namespace
}  // namespace varimap
