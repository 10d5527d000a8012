#include "varimap/sliding/target_cells.h"

#include <gtest/gtest.h>

#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"

namespace varimap {
namespace {

TEST(TargetCells, TellWhichAreaAMapLeaves) {
    const TriangleMesh sphere = shapes::ellipsoid(4);
    const PointMap identity = shapes::at_vertices(sphere);
    SlidingMap map(identity, sphere, sphere);
    const TargetCells cells(map, GeodesicGraph(map.target()), 0.03);
    const std::vector<char> before = cells.occupied(map.points());
    // The images of the upper cap go to the lower one: a sphere's caps have the area of their share of the
    // height.
    for (int v = 0; v < sphere.vertex_count(); ++v)
        if (sphere.vertex(v).z() > 0.5) map.place(v, identity[0]);
    EXPECT_NEAR(cells.lost_area(before, cells.occupied(map.points())), 0.25, 0.05);
    EXPECT_EQ(cells.lost_area(before, before), 0);
    EXPECT_EQ(cells.lost_area(cells.occupied(map.points()), before), 0) << "more is occupied than before";
}

}  // namespace
}  // namespace varimap
