#include "varimap/geodesics/surface_walk.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"
#include "varimap/mesh/closest_point.h"

namespace varimap {
namespace {

TEST(SurfaceWalk, IsStraightInThePlane) {
    const TriangleMesh square = shapes::square(7);
    const SurfaceWalk walk(square);
    const Vec3 start(0.21, 0.33, 0);
    const SurfacePoint from = ClosestPoint(square)(start).point;
    for (int i = 0; i < 24; ++i) {
        const double angle = 2 * std::numbers::pi * i / 24;
        const Vec3 step = 0.2 * Vec3(std::cos(angle), std::sin(angle), 0);
        const SurfacePoint end = walk(from, step);
        EXPECT_LT((position(square, end) - start - step).norm(), 1e-12) << angle;
        EXPECT_GE(end.barycentric.minCoeff(), 0);
        EXPECT_NEAR(end.barycentric.sum(), 1, 1e-12);
    }
}

TEST(SurfaceWalk, StartsAtVerticesInEveryDirection) {
    const TriangleMesh square = shapes::square(4);
    const SurfaceWalk walk(square);
    const PointMap vertices = shapes::at_vertices(square);
    for (int v = 0; v < square.vertex_count(); ++v) {
        const Vec3 start = square.vertex(v), step = 0.6 * (Vec3(0.51, 0.47, 0) - start);
        EXPECT_LT((position(square, walk(vertices[std::size_t(v)], step)) - start - step).norm(), 1e-12) << v;
    }
}

TEST(SurfaceWalk, KeepsItsLengthAcrossEdges) {
    // Two squares that meet at a right angle along the y axis.
    const TriangleMesh bent =
        shapes::make_mesh({{-1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {-1, 1, 0}, {0, 0, -1}, {0, 1, -1}},
                          {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}});
    const SurfacePoint from = ClosestPoint(bent)(Vec3(-0.5, 0.2, 0)).point;
    const SurfacePoint end = SurfaceWalk(bent)(from, Vec3(1, 0.4, 0));
    EXPECT_LT((position(bent, end) - Vec3(0, 0.6, -0.5)).norm(), 1e-12);
}

TEST(SurfaceWalk, ReturnsAroundASphere) {
    const TriangleMesh sphere = shapes::ellipsoid(4);
    const SurfacePoint from{17, Vec3(0.2, 0.5, 0.3)};
    const Vec3 normal = face_normal(sphere, 17).normalized();
    const Vec3 along = normal.cross(Vec3(0.3, -0.8, 0.1)).normalized();
    const SurfacePoint end = SurfaceWalk(sphere)(from, 2 * std::numbers::pi * along);
    EXPECT_LT((position(sphere, end) - position(sphere, from)).norm(), 0.05);
}

TEST(SurfaceWalk, SlidesAlongABoundary) {
    const TriangleMesh square = shapes::square(5);
    const SurfacePoint from = ClosestPoint(square)(Vec3(0.52, 0.51, 0)).point;
    const SurfacePoint beside = SurfaceWalk(square)(from, Vec3(0.2, 0.9, 0));
    EXPECT_LT((position(square, beside) - Vec3(0.72, 1, 0)).norm(), 1e-12);
    const SurfacePoint corner = SurfaceWalk(square)(from, Vec3(2, 3, 0));
    EXPECT_LT((position(square, corner) - Vec3(1, 1, 0)).norm(), 1e-12);
}

TEST(SurfaceWalk, EndsAtAFaceWithoutArea) {
    const TriangleMesh mesh = shapes::make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0.5, 0}, {1, 1, 0}},
                                                {{0, 1, 2}, {2, 1, 3}, {1, 4, 3}, {3, 4, 2}});
    const SurfacePoint end = SurfaceWalk(mesh)({0, Vec3(0.4, 0.3, 0.3)}, Vec3(1, 1, 0));
    ASSERT_GE(end.face, 0);
    EXPECT_TRUE(position(mesh, end).allFinite());
    EXPECT_NEAR(position(mesh, end).x() + position(mesh, end).y(), 1, 1e-9);
}

}  // namespace
}  // namespace varimap
