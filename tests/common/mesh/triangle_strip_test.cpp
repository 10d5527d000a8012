#include "varimap/mesh/triangle_strip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"

namespace varimap {
namespace {

Vec3 heading_between(const TriangleMesh& mesh, const SurfacePoint& a, const SurfacePoint& b) {
    const Edges edges = find_edges(mesh);
    TriangleStrip strip = find_strip(mesh, edges, a.face, b.face, mesh.face_count());
    EXPECT_EQ(strip.faces.front(), a.face);
    EXPECT_EQ(strip.faces.back(), b.face);
    EXPECT_EQ(strip.edges.size() + 1, strip.faces.size());
    const Vec3 start = position(mesh, a), goal = position(mesh, b);
    straighten(mesh, edges, strip, start, goal);
    return heading(mesh, edges, strip, start, goal);
}

TEST(Heading, IsTheDifferenceInThePlane) {
    const TriangleMesh square = shapes::square(7);
    for (const int f : {0, 10, 55})
        for (const int g : {3, 10, 12, 97}) {
            const SurfacePoint a{f, {0.5, 0.2, 0.3}}, b{g, {0.1, 0.3, 0.6}};
            EXPECT_LT((heading_between(square, a, b) - (position(square, b) - position(square, a))).norm(),
                      1e-12);
        }
}

TEST(Heading, LeavesAlongGreatCircles) {
    const TriangleMesh sphere = shapes::ellipsoid(4);
    const PointMap at = shapes::at_vertices(sphere);
    const SurfacePoint from{700, {0.3, 0.3, 0.4}};
    const Vec3 p = position(sphere, from).normalized();
    for (int v = 0; v < sphere.vertex_count(); v += 37) {
        const double angle = std::acos(std::clamp(p.dot(sphere.vertex(v)), -1., 1.));
        if (angle < 0.1 || angle > 1.5) continue;
        const Vec3 away = heading_between(sphere, from, at[std::size_t(v)]);
        const Vec3 expected = (sphere.vertex(v) - p * p.dot(sphere.vertex(v))).normalized();
        EXPECT_NEAR(away.norm(), angle, 0.02 * angle);
        EXPECT_GT(away.normalized().dot(expected), 0.995);
    }
}

TEST(FindStrip, GivesUpWhereToldTo) {
    const TriangleMesh square = shapes::square(10);
    const Edges edges = find_edges(square);
    EXPECT_FALSE(find_strip(square, edges, 0, 199, 200).faces.empty());
    EXPECT_TRUE(find_strip(square, edges, 0, 199, 5).faces.empty());
}

}  // namespace
}  // namespace varimap
