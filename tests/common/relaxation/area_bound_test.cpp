#include "varimap/relaxation/area_bound.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"
#include "varimap/quality/quality.h"
#include "varimap/relaxation/local_relaxation.h"
#include "varimap/untangling/untangling.h"

namespace varimap {
namespace {

using shapes::none;

/// A ball onto an egg, both ways: an isometry's energy trades areas for angles at the tips.
MapPair ball_to_egg(const TriangleMesh& ball, const TriangleMesh& egg, double area_bound) {
    MapPair maps{shapes::at_vertices(egg), shapes::at_vertices(ball)};
    UntanglingOptions options;
    options.area_bound = area_bound;
    untangle(maps, ball, egg, {none(ball), none(egg)}, options);
    return maps;
}

double share_within(const PointMap& map, const TriangleMesh& source, const TriangleMesh& target,
                    double bound) {
    return share_within_area_bound(measure_triangles(map, source, target), source, bound);
}

TEST(AreaBound, IsKeptByTheFinishedMap) {
    const TriangleMesh ball = shapes::ellipsoid(4), egg = shapes::ellipsoid(4, {1, 1, 3});
    const double bound = 1.15;
    const MapPair without = ball_to_egg(ball, egg, 0), with = ball_to_egg(ball, egg, bound);
    EXPECT_LT(share_within(without.A_to_B, ball, egg, bound), 0.95);
    EXPECT_GT(share_within(with.A_to_B, ball, egg, bound), 0.999);
    EXPECT_GT(share_within(with.B_to_A, egg, ball, bound), 0.999);
    EXPECT_EQ(measure_distortion(with.A_to_B, ball, egg).flipped_count, 0);
}

TEST(AreaBound, ATightOneIsKeptFromTheStart) {
    const TriangleMesh ball = shapes::ellipsoid(4), spindle = shapes::ellipsoid(4, {1, 1, 8});
    const double bound = 1.15;
    ASSERT_TRUE(AreaBound::is_tight(bound));
    const MapPair maps = ball_to_egg(ball, spindle, bound);
    EXPECT_GT(share_within(maps.A_to_B, ball, spindle, bound), 0.965);
    // Where it is kept in the end alone, .961.
    EXPECT_GT(share_within(maps.B_to_A, spindle, ball, bound), 0.995);
}

TEST(AreaBound, IsRestoredAfterRepairs) {
    const TriangleMesh figure = shapes::figure(0.15);
    TriangleMesh tall = figure;
    tall.vertices.col(2) *= 2.5;
    const double bound = 1.2;
    const auto share = [&](bool restored) {
        MapPair maps{shapes::at_vertices(tall), shapes::at_vertices(figure)};
        UntanglingOptions options;
        options.area_bound = bound;
        options.restore_bound = restored;
        untangle(maps, figure, tall, {none(figure), none(tall)}, options);
        return std::min(share_within(maps.A_to_B, figure, tall, bound),
                        share_within(maps.B_to_A, tall, figure, bound));
    };
    EXPECT_LT(share(false), 0.99);
    EXPECT_GT(share(true), 0.998);
}

TEST(AreaBound, PressesWhereItIsNotKeptAndNowhereElse) {
    const TriangleMesh ball = shapes::ellipsoid(3), egg = shapes::ellipsoid(3, {1, 1, 3});
    SlidingMap map(shapes::at_vertices(egg), ball, egg);
    VertexData<bool> exempt = none(ball);
    const auto weighted = [&] {
        int count = 0;
        for (int f = 0; f < ball.face_count(); ++f) count += map.rest(f).area_weight > 0;
        return count;
    };
    {
        AreaBound bound(map, 1.2, exempt);
        const std::vector<int> pressed = bound.press();
        EXPECT_GT(pressed.size(), 10u);
        EXPECT_LT(pressed.size(), std::size_t(ball.vertex_count()));
        EXPECT_GT(weighted(), 0);
        EXPECT_LT(weighted(), ball.face_count());
    }
    EXPECT_EQ(weighted(), 0) << "the weights go with the bound";
    EXPECT_TRUE(AreaBound(map, 100, exempt).press().empty());
    for (auto& e : exempt) e = true;
    EXPECT_TRUE(AreaBound(map, 1.2, exempt).press().empty());
}

TEST(AreaBound, PressesAgainAroundWhatMovedAsItDoesEverywhere) {
    const TriangleMesh ball = shapes::ellipsoid(3), egg = shapes::ellipsoid(3, {1, 1, 3});
    SlidingMap map(shapes::at_vertices(egg), ball, egg), same(shapes::at_vertices(egg), ball, egg);
    AreaBound bound(map, 1.2, none(ball)), everywhere(same, 1.2, none(ball));
    std::vector<int> pressed = bound.press();
    everywhere.press();
    for (int step = 0; step < 4; ++step) {
        const std::vector<int> before = pressed;
        for (SlidingMap* moved : {&map, &same}) {
            std::vector<int> order = before;
            LocalRelaxation(*moved, 99).sweep(order, {1, 0.03});
        }
        pressed = bound.press_again(before);
        EXPECT_EQ(pressed, everywhere.press());
        EXPECT_NE(pressed, before) << "some moved into the bound or out of it";
    }
    for (int f = 0; f < ball.face_count(); ++f) EXPECT_EQ(map.rest(f).area_weight, same.rest(f).area_weight);
}

}  // namespace
}  // namespace varimap
