#include "varimap/geodesics/log_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"
#include "varimap/mesh/closest_point.h"

namespace varimap {
namespace {

using std::numbers::pi;

/// Angles from each of the places to the next, as seen from a point.
std::vector<double> turns(const LogMap& log_map, const SurfacePoint& from, const PointMap& places) {
    std::vector<double> angles;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const auto u = log_map(from, places[i]).first,
                   w = log_map(from, places[(i + 1) % places.size()]).first;
        angles.push_back(std::atan2(u.x() * w.y() - u.y() * w.x(), u.dot(w)));
    }
    return angles;
}

TEST(LogMap, IsTheDifferenceInThePlane) {
    const TriangleMesh square = shapes::square(6);
    const LogMap log_map(square);
    const SurfacePoint a{20, {0.2, 0.3, 0.5}}, b{49, {0.6, 0.3, 0.1}};
    const auto [there, back] = log_map(a, b);
    EXPECT_NEAR(there.norm(), (position(square, b) - position(square, a)).norm(), 1e-12);
    EXPECT_NEAR(back.norm(), there.norm(), 1e-12);
}

TEST(LogMap, TurnsOnceAroundTipsAndOrdinaryPoints) {
    // A cone whose faces have a sixth of a full turn at its tip.
    const int n = 12;
    TriangleMesh cone{Points(n + 1, 3), Faces(n, 3)};
    cone.vertices.row(n) << 0, 0, 6;
    PointMap rim;
    for (int i = 0; i < n; ++i) {
        cone.vertices.row(i) << std::cos(2 * pi * i / n), std::sin(2 * pi * i / n), 0;
        cone.faces.row(i) << i, (i + 1) % n, n;
        rim.push_back({i, {1, 0, 0}});
    }
    const LogMap log_map(cone);
    const std::vector<double> at_tip = turns(log_map, {5, {0, 0, 1}}, rim);
    for (const double angle : at_tip) EXPECT_NEAR(angle, 2 * pi / n, 1e-9);
    const TriangleMesh sphere = shapes::ellipsoid(3);
    const PointMap at = shapes::at_vertices(sphere);
    for (const int f : {5, 300}) {
        PointMap corners;
        for (int k = 0; k < 3; ++k) corners.push_back(at[std::size_t(sphere.faces(f, k))]);
        double sum = 0;
        for (const double angle : turns(LogMap(sphere), {f, {0.2, 0.3, 0.5}}, corners)) sum += angle;
        EXPECT_NEAR(sum, 2 * pi, 1e-9);
    }
}

TEST(LogMap, LooksOnlySoFar) {
    const TriangleMesh sphere = shapes::ellipsoid(3);
    const PointMap at = shapes::at_vertices(sphere);
    const auto distance = [&](int farthest, const SurfacePoint& to) {
        return LogMap(sphere)(at[0], to, farthest).first.norm();
    };
    const SurfacePoint &near = at[std::size_t(vertex_neighbours(sphere)[0][0])],
                       &far = at[3];  // the opposite pole
    EXPECT_GT(distance(20, near), 0.05);
    EXPECT_NEAR(distance(20, near), distance(20'000, near), 1e-12);
    EXPECT_EQ(distance(20, far), 0);
    EXPECT_GT(distance(20'000, far), 1);
}

TEST(LogMap, SeesAroundARimButNotThroughAPlate) {
    const TriangleMesh plate = shapes::ellipsoid(4, {1, 1, 0.02});
    const LogMap log_map(plate);
    const ClosestPoint closest(plate);
    const auto distance_through = [&](double x) {
        return log_map(closest(Vec3(x, 0.01, 0.02)).point, closest(Vec3(x, 0.01, -0.02)).point).first.norm();
    };
    EXPECT_NEAR(distance_through(0.95), 0.1, 0.05);
    EXPECT_EQ(distance_through(0), 0);
}

}  // namespace
}  // namespace varimap
