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
        EXPECT_TRUE(found.of_source[c].has_partner() && found.of_target[c].has_partner());
    }
    EXPECT_EQ(found.of_source[2].vertex, 2 * shapes::ellipsoid(1).vertex_count());
    EXPECT_NEAR(found.of_source[1].area, .09 / 1.18, 1e-3);
}

TEST(Components, AreAstrayWhereOneTakesTheOthersPlace) {
    const TriangleMesh balls = three_balls();
    const PointMap map = third_on_second(balls);
    const ComponentImages found = measure_components(map, map, balls, balls);
    EXPECT_TRUE(found.are_astray());
    EXPECT_TRUE(found.of_source[1].has_partner());
    EXPECT_FALSE(found.of_source[2].has_partner());
    EXPECT_EQ(found.of_source[2].onto, 1);
    EXPECT_FALSE(found.of_target[2].has_partner());
}

TEST(Components, ThatTheOtherLacksHaveNoPartnerAndAreNotAstray) {
    const TriangleMesh balls = three_balls(), one = shapes::ellipsoid(1);
    PointMap there = points_at_vertices(balls);
    for (std::size_t v = 0; v < there.size(); ++v)
        there[v] = v < std::size_t(one.vertex_count()) ? there[v] : SurfacePoint{};
    const ComponentImages found = measure_components(there, points_at_vertices(one), balls, one);
    EXPECT_FALSE(found.are_astray());
    EXPECT_TRUE(found.of_source[0].has_partner());
    EXPECT_EQ(found.of_source[1].onto, -1);
    EXPECT_FALSE(found.of_source[1].has_partner());
    ASSERT_EQ(found.of_target.size(), 1u);
    EXPECT_TRUE(found.of_target[0].has_partner());
}

/// A scan may be in one piece where another is not.
TEST(Components, OfPiecesOfWhatIsWholeOnTheOtherHaveTheirPlaceThere) {
    const TriangleMesh whole = shapes::ellipsoid(3);
    std::vector<int> upper, lower;
    for (int f = 0; f < whole.face_count(); ++f)
        (whole.vertices(whole.faces.row(f), 2).minCoeff() >= .3 ? upper : lower).push_back(f);
    const TriangleMesh pieces = shapes::together({whole.vertices, whole.faces(upper, Eigen::all)},
                                                 {whole.vertices, whole.faces(lower, Eigen::all)});
    const PointMap on_pieces = points_at_vertices(pieces), on_whole = points_at_vertices(whole);
    const auto count = std::size_t(whole.vertex_count());
    PointMap there = on_whole, back;
    there.insert(there.end(), on_whole.begin(), on_whole.end());
    for (std::size_t v = 0; v < count; ++v)
        back.push_back(on_pieces[v].face >= 0 ? on_pieces[v] : on_pieces[v + count]);
    const ComponentImages found = measure_components(there, back, pieces, whole);
    ASSERT_EQ(found.of_source.size(), 2u);
    EXPECT_TRUE(found.of_source[0].has_partner() && found.of_source[1].has_partner());
    EXPECT_TRUE(found.of_target[0].has_partner());
    EXPECT_TRUE(found.opposed().empty());
}

TEST(Components, AreOpposedWhereOneLooksInward) {
    const TriangleMesh balls = three_balls();
    TriangleMesh turned = balls;
    const int last = shapes::ellipsoid(1).face_count();
    turned.faces.bottomRows(last).col(1).swap(turned.faces.bottomRows(last).col(2));
    const ComponentImages found =
        measure_components(points_at_vertices(turned), points_at_vertices(balls), balls, turned);
    EXPECT_EQ(found.opposed(), std::vector<int>{2});
    TriangleMesh mirrored = balls;
    mirrored.faces.col(1).swap(mirrored.faces.col(2));
    EXPECT_TRUE(measure_components(points_at_vertices(mirrored), points_at_vertices(balls), balls, mirrored)
                    .opposed()
                    .empty())
        << "as --mirror has it";
    EXPECT_EQ(found.of_source[2].orientation, 1);
    EXPECT_EQ(found.of_target[2].orientation, -1);
}

}  // namespace
}  // namespace varimap
