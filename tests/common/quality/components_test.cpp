#include "varimap/quality/components.h"

#include <gtest/gtest.h>

#include "fixtures/shapes.h"
#include "fixtures/together.h"
#include "varimap/mesh/closest_point.h"

namespace varimap {
namespace {

/// A large ball and two small ones beside it.
TriangleMesh three_balls() {
    const auto ball_at = [](double x, double radius) {
        TriangleMesh ball = shapes::ellipsoid(1, {radius, radius, radius});
        ball.vertices.col(0).array() += x;
        return ball;
    };
    return shapes::together(shapes::together(ball_at(0, 1), ball_at(2, .3)), ball_at(3, .3));
}

/// Takes the last component to the one before it.
PointMap third_on_second(const TriangleMesh& balls) {
    PointMap map = points_at_vertices(balls);
    const int faces = shapes::ellipsoid(1).face_count(), vertices = shapes::ellipsoid(1).vertex_count();
    for (int v = 2 * vertices; v < 3 * vertices; ++v) map[v].face -= faces;
    return map;
}

TEST(Components, ArePartnersWhereEachLiesOnTheOther) {
    const TriangleMesh balls = three_balls();
    const PointMap itself = points_at_vertices(balls);
    const ComponentImages found = measure_components(itself, itself, balls, balls);
    ASSERT_EQ(found.of_source.size(), 3u);
    EXPECT_TRUE(found.are_several());
    EXPECT_FALSE(found.are_astray());
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_EQ(found.of_source[c].onto, int(c));
        EXPECT_NEAR(found.of_source[c].on_that, 1, 1e-9);
        EXPECT_TRUE(found.of_source[c].has_partner && found.of_target[c].has_partner);
    }
    EXPECT_EQ(found.of_source[2].vertex, 2 * shapes::ellipsoid(1).vertex_count());
    EXPECT_NEAR(found.of_source[1].area, .09 / 1.18, 1e-3);
}

TEST(Components, AreAstrayWhereOneTakesTheOthersPlace) {
    const TriangleMesh balls = three_balls();
    const PointMap map = third_on_second(balls);
    const ComponentImages found = measure_components(map, map, balls, balls);
    EXPECT_TRUE(found.are_astray());
    EXPECT_TRUE(found.of_source[1].has_partner);
    EXPECT_FALSE(found.of_source[2].has_partner);
    EXPECT_EQ(found.of_source[2].onto, 1);
    EXPECT_FALSE(found.of_target[2].has_partner);
}

TEST(Components, ThatTheOtherLacksHaveNoPartnerAndAreNotAstray) {
    const TriangleMesh balls = three_balls(), one = shapes::ellipsoid(1);
    PointMap there = points_at_vertices(balls);
    for (std::size_t v = 0; v < there.size(); ++v)
        there[v] = v < std::size_t(one.vertex_count()) ? there[v] : SurfacePoint{};
    const ComponentImages found = measure_components(there, points_at_vertices(one), balls, one);
    EXPECT_FALSE(found.are_astray());
    EXPECT_TRUE(found.of_source[0].has_partner);
    EXPECT_EQ(found.of_source[1].onto, -1);
    EXPECT_FALSE(found.of_source[1].has_partner);
    ASSERT_EQ(found.of_target.size(), 1u);
    EXPECT_TRUE(found.of_target[0].has_partner);
}

}  // namespace
}  // namespace varimap
