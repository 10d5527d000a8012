#include "varimap/quality/twist.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fixtures/twisted_shaft.h"

namespace varimap {
namespace {

TEST(Twist, IsTheAngleByWhichTheEndsAreTurnedAgainstEachOther) {
    const TriangleMesh shaft = shapes::shaft();
    EXPECT_LT(measure_twist(shapes::twisted_shaft(shaft, 0), shaft, shaft).degrees, 5);
    for (const double degrees : {120., 300., -200.}) {
        const Twist twist = measure_twist(shapes::twisted_shaft(shaft, degrees), shaft, shaft);
        // Distances rise a little aslant, so that it is taken for less.
        EXPECT_GT(twist.degrees, .8 * std::abs(degrees));
        EXPECT_LT(twist.degrees, 1.05 * std::abs(degrees));
        ASSERT_GE(twist.vertex, 0);
        EXPECT_LT(std::abs(shaft.vertex(twist.vertex)[0]), .5);
        EXPECT_GT(twist.area, .5);
    }
}

TEST(Twist, IsNoneOfATurnAsAWholeAndOfASheet) {
    const TriangleMesh shaft = shapes::shaft();
    const PointMap turned = shapes::turned_shaft(shaft, [](double) { return 120; });
    EXPECT_LT(measure_twist(turned, shaft, shaft).degrees, 30);
    const TriangleMesh sheet = shapes::square(20);
    const ClosestPoint closest(sheet);
    PointMap sheared;
    for (int v = 0; v < sheet.vertex_count(); ++v)
        sheared.push_back(closest(sheet.vertex(v) + Vec3(.3 * sheet.vertex(v)[1], 0, 0)).point);
    EXPECT_EQ(measure_twist(sheared, sheet, sheet).vertex, -1);
}

TEST(Twist, IsTakenOutByItsTurnsButFullOnesLeaveTheEnds) {
    const TriangleMesh shaft = shapes::shaft();
    const auto turn_of_ends = [&](double degrees) {
        const auto found = untwisting(shapes::twisted_shaft(shaft, degrees), shaft, shaft, 0);
        EXPECT_TRUE(found.has_value());
        int first = 0, last = 0;
        shaft.vertices.col(0).minCoeff(&first);
        shaft.vertices.col(0).maxCoeff(&last);
        return std::abs(found->turn[std::size_t(last)] - found->turn[std::size_t(first)]) * 180 /
               std::numbers::pi;
    };
    EXPECT_NEAR(turn_of_ends(120), 120, 20);
    EXPECT_NEAR(turn_of_ends(330), 360, 1);
}

}  // namespace
}  // namespace varimap
