#include "varimap/map_repair/bound_repair.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"
#include "varimap/map_repair/normal_agreement.h"
#include "varimap/quality/quality.h"
#include "varimap/sliding/along_target.h"

namespace varimap {
namespace {

using ::testing::IsSupersetOf;

using shapes::none;

double share_within(const SlidingMap& map, double bound) {
    return share_within_area_bound(measure_triangles(map.points(), map.source(), map.target()), map.source(),
                                   bound);
}

/// Reversed, or cutting through a feature.
std::vector<int> faulty_faces(SlidingMap& map) {
    AlongTarget along_target(map);
    return NormalAgreement(map, along_target).disagreeing_faces();
}

void repair_bound(SlidingMap& map, double bound, const VertexData<bool>& held) {
    BoundRepair(map, bound, none(map.source()), held)({1, 0.1});
}

TEST(BoundRepair, BringsAreasBackIntoTheBound) {
    const TriangleMesh ball = shapes::ellipsoid(4), egg = shapes::ellipsoid(4, {1, 1, 3});
    SlidingMap map(shapes::at_vertices(egg), ball, egg);
    const double bound = 1.4;
    ASSERT_LT(share_within(map, bound), 0.9);
    repair_bound(map, bound, none(ball));
    EXPECT_GT(share_within(map, bound), 0.995);
    EXPECT_TRUE(faulty_faces(map).empty());
}

TEST(BoundRepair, MakesNoFaults) {
    const TriangleMesh figure = shapes::figure(0.15);
    TriangleMesh tall = figure;
    tall.vertices.col(2) *= 3;
    SlidingMap map(shapes::at_vertices(tall), figure, tall);
    const std::vector<int> before = faulty_faces(map);
    repair_bound(map, 1.2, none(figure));
    // Without being taken back some are new.
    EXPECT_THAT(before, IsSupersetOf(faulty_faces(map)));
    EXPECT_GT(share_within(map, 1.2), 0.999);
}

TEST(BoundRepair, LeavesHeldVerticesAndMapsWithinTheBound) {
    const TriangleMesh ball = shapes::ellipsoid(3), egg = shapes::ellipsoid(3, {1, 1, 3});
    const PointMap given = shapes::at_vertices(egg);
    SlidingMap map(given, ball, egg), within(given, ball, egg);
    VertexData<bool> held = none(ball);
    for (int v = 0; v < held.size(); v += 2) held[v] = true;
    repair_bound(map, 1.2, held);
    repair_bound(within, 100, none(ball));
    const auto is_same = [&](const SlidingMap& now, int v) {
        const SurfacePoint &a = now.point(v), &b = given[std::size_t(v)];
        return a.face == b.face && a.barycentric == b.barycentric;
    };
    int moved = 0;
    for (int v = 0; v < held.size(); ++v) {
        EXPECT_TRUE(is_same(map, v) || !held[v]);
        moved += !is_same(map, v);
        EXPECT_TRUE(is_same(within, v));
    }
    EXPECT_GT(moved, 10);
}

}  // namespace
}  // namespace varimap
