#include "varimap/core/indexed.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace varimap {
namespace {

static_assert(!std::is_convertible_v<VertexData<int>, FaceData<int>>, "kinds are told apart");
static_assert(std::is_same_v<decltype(std::declval<VertexData<bool>&>()[0]), char&>,
              "flags are values of their own");

TEST(PerElement, HoldsOneValuePerElement) {
    VertexData<double> weights(3, 0.5);
    weights[1] = 2;
    EXPECT_EQ(weights.size(), 3);
    EXPECT_EQ(weights[0], 0.5);
    EXPECT_EQ(weights[1], 2);
    EXPECT_EQ(FaceData<int>(2)[1], 0);
    EXPECT_EQ(VertexData<bool>().size(), 0);
}

TEST(PerElement, ConvertsFromAndToAVector) {
    std::vector<char> marks{0, 1, 1};
    const VertexData<bool> copied(marks), moved = std::move(marks);
    const std::vector<char>& seen = copied;
    EXPECT_EQ(seen, (std::vector<char>{0, 1, 1}));
    EXPECT_EQ(copied, moved);
    EXPECT_EQ(std::count(moved.begin(), moved.end(), 1), 2);
}

}  // namespace
}  // namespace varimap
