#include "varimap/results/landmark_words.h"

#include <gtest/gtest.h>

namespace varimap {
namespace {

TEST(LandmarkWords, ListsTheFirstTenNames) {
    EXPECT_EQ(list_in_words({"2"}), "2");
    EXPECT_EQ(list_in_words({"2", "3"}), "2 and 3");
    EXPECT_EQ(list_in_words({"2", "3", "9"}), "2, 3 and 9");
    EXPECT_EQ(list_in_words(std::vector<std::string>(12, "1")), "1, 1, 1, 1, 1, 1, 1, 1, 1, 1 and 2 more");
}

TEST(LandmarkWords, CountExchangedOnesFromOne) {
    EXPECT_EQ(exchanged_in_words({{0, 2}}), "1 and 3");
    EXPECT_EQ(exchanged_in_words({{0, 2}, {1, 3}}), "1 with 3 and 2 with 4");
    EXPECT_EQ(exchanged_in_words({{0, 2}, {1, 3}, {4, 5}}), "1 with 3, 2 with 4 and 5 with 6");
}

}  // namespace
}  // namespace varimap
