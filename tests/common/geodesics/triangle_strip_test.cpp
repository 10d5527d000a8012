#include "varimap/geodesics/triangle_strip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"
#include "varimap/geodesics/funnel.h"
#include "varimap/mesh/closest_point.h"

namespace varimap {
namespace {

StraightPath path_between(const TriangleMesh& mesh, const SurfacePoint& a, const SurfacePoint& b) {
    const Edges edges = find_edges(mesh);
    TriangleStrip strip = find_strip(mesh, edges, a.face, b.face, mesh.face_count());
    EXPECT_EQ(strip.faces.front(), a.face);
    EXPECT_EQ(strip.faces.back(), b.face);
    EXPECT_EQ(strip.edges.size() + 1, strip.faces.size());
    const Vec3 start = position(mesh, a), goal = position(mesh, b);
    const StraightPath path = straighten(mesh, edges, strip, start, goal);
    EXPECT_EQ(straight_path(mesh, edges, strip, start, goal).length, path.length);
    return path;
}

TEST(StraightPath, IsTheDifferenceInThePlane) {
    const TriangleMesh square = shapes::square(7);
    for (const int f : {0, 10, 55})
        for (const int g : {3, 10, 12, 97}) {
            const SurfacePoint a{f, {0.5, 0.2, 0.3}}, b{g, {0.1, 0.3, 0.6}};
            const Vec3 difference = position(square, b) - position(square, a);
            const StraightPath path = path_between(square, a, b);
            EXPECT_LT((path.goal_from_start - difference).norm(), 1e-12);
            EXPECT_LT((path.start_from_goal + difference).norm(), 1e-12);
        }
}

TEST(StraightPath, FollowsGreatCircles) {
    const TriangleMesh sphere = shapes::ellipsoid(4);
    const SurfacePoint from{700, {0.3, 0.3, 0.4}};
    const Vec3 p = position(sphere, from).normalized();
    for (int f = 0; f < sphere.face_count(); f += 67) {
        const SurfacePoint to{f, {0.5, 0.2, 0.3}};
        const Vec3 q = position(sphere, to).normalized();
        const double angle = std::acos(std::clamp(p.dot(q), -1., 1.));
        if (angle < 0.1 || angle > 1.5) continue;
        const StraightPath path = path_between(sphere, from, to);
        EXPECT_NEAR(path.length, angle, 0.02 * angle);
        EXPECT_NEAR(path.goal_from_start.norm(), path.length, 1e-12);
        EXPECT_GT(path.goal_from_start.normalized().dot((q - p * p.dot(q)).normalized()), 0.995);
        EXPECT_GT(path.start_from_goal.normalized().dot((p - q * q.dot(p)).normalized()), 0.995);
    }
}

TriangleStrip strip_through(const Edges& edges, const std::vector<int>& faces) {
    TriangleStrip strip{faces, {}};
    for (std::size_t i = 0; i + 1 < faces.size(); ++i)
        for (int side = 3 * faces[i]; side < 3 * faces[i] + 3; ++side)
            for (const int other : edges.half_edges[edges.of_half_edge[std::size_t(side)]])
                if (other / 3 == faces[i + 1]) strip.edges.push_back(edges.of_half_edge[std::size_t(side)]);
    return strip;
}

/// Six faces around an apex at a height above a hexagon, whose corners rise and fall by `waves`.
TriangleMesh spike_of(double height, double waves) {
    TriangleMesh spike;
    spike.vertices.resize(7, 3);
    spike.faces.resize(6, 3);
    spike.vertices.row(6) << 0, 0, height;
    for (int k = 0; k < 6; ++k) {
        spike.vertices.row(k) << std::cos(k * M_PI / 3), std::sin(k * M_PI / 3), k % 2 == 0 ? waves : -waves;
        spike.faces.row(k) << k, (k + 1) % 6, 6;
    }
    return spike;
}

TEST(StraightPath, PassesASpikeOnItsShorterSide) {
    const TriangleMesh spike = spike_of(5, 0);  // paths around either side are locally shortest
    const Edges edges = find_edges(spike);
    const Vec3 start = position(spike, {0, {0.4, 0.1, 0.5}}), goal = position(spike, {2, {0.1, 0.4, 0.5}});
    TriangleStrip longer = strip_through(edges, {0, 5, 4, 3, 2}), shorter = strip_through(edges, {0, 1, 2});
    const double around = straight_path(spike, edges, longer, start, goal).length;
    const StraightPath expected = straighten(spike, edges, shorter, start, goal);
    const StraightPath path = straighten(spike, edges, longer, start, goal);
    EXPECT_GT(around, 1.1 * expected.length);
    EXPECT_EQ(longer.faces, shorter.faces);
    EXPECT_EQ(path.length, expected.length);
}

/// Of both ways around an apex the shorter one is found from either, wherever either leads past it. With a
/// third face on an edge there, which only one of them crosses, or with faces turned over, too.
TEST(StraightPath, TakesTheShorterOfBothWaysAroundAVertex) {
    int changed = 0;
    for (const auto& [height, waves] : {std::pair(5., 0.), {1., 0.}, {.3, 0.}, {.8, .3}, {0., .4}, {.1, 1.}})
        for (const bool has_fin : {false, true})
            for (int to = 1; to < 6; ++to) {
                TriangleMesh spike = spike_of(height, waves);
                if (has_fin) {  // on the edge between the last two of the faces that lead the other way round
                    spike.vertices.conservativeResize(8, 3);
                    spike.vertices.row(7) << 2, 2, 2;
                    spike.faces.conservativeResize(7, 3);
                    spike.faces.row(6) << 0, 6, 7;
                    std::swap(spike.faces(4, 0), spike.faces(4, 1));
                }
                const Edges edges = find_edges(spike);
                std::vector<int> there, around{0};
                for (int k = 0; k <= to; ++k) there.push_back(k);
                for (int k = 5; k >= to; --k) around.push_back(k);
                const Vec3 start = position(spike, {0, {0.35, 0.15, 0.5}}),
                           goal = position(spike, {to, {0.2, 0.3, 0.5}});
                const double one =
                                 straight_path(spike, edges, strip_through(edges, there), start, goal).length,
                             other = straight_path(spike, edges, strip_through(edges, around), start, goal)
                                         .length;
                TriangleStrip strip = strip_through(edges, has_fin ? around : other < one ? there : around);
                const double longer = straight_path(spike, edges, strip, start, goal).length;
                if (longer < 1.03 * (goal - start).norm()) continue;  // is not asked for
                EXPECT_NEAR(straighten(spike, edges, strip, start, goal).length, std::min(one, other), 1e-9)
                    << height << " " << waves << " " << has_fin << " " << to;
                changed += longer > std::min(one, other) + 1e-9;
            }
    EXPECT_GT(changed, 20);
}

TEST(StraightStrip, LeadsThereWhereASearchWouldToo) {
    const TriangleMesh sphere = shapes::ellipsoid(4);
    const Edges edges = find_edges(sphere);
    const SurfacePoint from{700, {0.3, 0.3, 0.4}};
    const Vec3 start = position(sphere, from);
    int found = 0;
    for (int f = 0; f < sphere.face_count(); ++f) {
        const SurfacePoint to{f, {0.5, 0.2, 0.3}};
        const Vec3 goal = position(sphere, to);
        if ((goal - start).norm() > 0.8) continue;
        TriangleStrip strip = straight_strip(sphere, edges, from, to);
        if (strip.faces.empty()) continue;
        ++found;
        EXPECT_EQ(strip.faces.front(), from.face);
        EXPECT_EQ(strip.faces.back(), f);
        ASSERT_EQ(strip.edges.size() + 1, strip.faces.size());
        TriangleStrip searched = find_strip(sphere, edges, from.face, f, sphere.face_count());
        EXPECT_NEAR(straighten(sphere, edges, strip, start, goal).length,
                    straighten(sphere, edges, searched, start, goal).length, 1e-5)
            << "both locally shortest, past vertices of little curvature";
    }
    EXPECT_GT(found, 200);
}

TEST(StraightStrip, FindsNothingOnTheOtherSideOfAPlate) {
    const TriangleMesh plate = shapes::ellipsoid(3, {1, 1, 0.05});
    const Edges edges = find_edges(plate);
    const ClosestPoint closest(plate);
    const SurfacePoint above = closest(Vec3(0.3, 0.2, 1)).point, below = closest(Vec3(0.35, 0.2, -1)).point,
                       beside = closest(Vec3(0.35, 0.2, 1)).point;
    EXPECT_FALSE(straight_strip(plate, edges, above, beside).faces.empty());
    EXPECT_TRUE(straight_strip(plate, edges, above, below).faces.empty());
}

TEST(FindStrip, GivesUpWhereToldTo) {
    const TriangleMesh square = shapes::square(10);
    const Edges edges = find_edges(square);
    EXPECT_FALSE(find_strip(square, edges, 0, 199, 200).faces.empty());
    EXPECT_TRUE(find_strip(square, edges, 0, 199, 5).faces.empty());
}

}  // namespace
}  // namespace varimap
