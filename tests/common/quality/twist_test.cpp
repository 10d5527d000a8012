#include "varimap/quality/twist.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fixtures/together.h"
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

/// Wherever in the file the twisted component is.
TEST(Twist, IsFoundOnAnyComponent) {
    const TriangleMesh shaft = shapes::shaft();
    const PointMap twisted = shapes::twisted_shaft(shaft, 200);
    const TriangleMesh crumb = shapes::ellipsoid(0, {.05, .05, .05});
    const double alone = measure_twist(twisted, shaft, shaft).degrees;
    ASSERT_GT(alone, 150);
    for (const bool crumb_first : {false, true}) {
        const TriangleMesh both =
            crumb_first ? shapes::together(crumb, shaft) : shapes::together(shaft, crumb);
        PointMap map = points_at_vertices(both);
        for (std::size_t v = 0; v < twisted.size(); ++v) {
            SurfacePoint image = twisted[v];
            if (crumb_first) image.face += crumb.face_count();
            map[v + (crumb_first ? std::size_t(crumb.vertex_count()) : 0)] = image;
        }
        EXPECT_NEAR(measure_twist(map, both, both).degrees, alone, 10) << crumb_first;
    }
}

}  // namespace
}  // namespace varimap
