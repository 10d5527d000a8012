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
    EXPECT_EQ(contradicted_landmark({{.85, .011}, {.7, .03}}), -1) << "of a limb that is left open";
}

}  // namespace
}  // namespace varimap
