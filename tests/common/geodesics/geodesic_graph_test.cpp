#include "varimap/geodesics/geodesic_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "fixtures/shapes.h"

namespace varimap {
namespace {

std::vector<double> distances(GeodesicBall& ball, int source, int vertices) {
    std::vector<double> distance(std::size_t(vertices), -1);
    ball.grow(source, [&](int v, double d) {
        distance[std::size_t(v)] = d;
        return true;
    });
    return distance;
}

TEST(GeodesicGraph, HasEdgesAndTheDiagonalsOfUnfoldedPairs) {
    // A square folded along its diagonal by a right angle: the other diagonal has the length it has unfolded.
    const TriangleMesh mesh =
        shapes::make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {.5, .5, std::sqrt(.5)}}, {{0, 1, 2}, {1, 3, 2}});
    const GeodesicGraph graph(mesh);
    EXPECT_EQ(graph.target.size(), 12u);
    GeodesicBall ball(graph);
    const std::vector<double> distance = distances(ball, 0, 4);
    EXPECT_NEAR(distance[1], 1, 1e-12);
    EXPECT_NEAR(distance[3], std::sqrt(2), 1e-12);
}

TEST(GeodesicGraph, OverestimatesByAFewPercentOnASphere) {
    const TriangleMesh mesh = shapes::ellipsoid(4);
    const GeodesicGraph graph(mesh);
    GeodesicBall ball(graph);
    for (int source : {0, 7, 1000}) {
        const std::vector<double> distance = distances(ball, source, mesh.vertex_count());
        for (int v = 0; v < mesh.vertex_count(); ++v) {
            const double arc = std::acos(std::min(1., mesh.vertex(v).dot(mesh.vertex(source))));
            EXPECT_GE(distance[std::size_t(v)], .995 * arc - 1e-6);
            EXPECT_LE(distance[std::size_t(v)], 1.06 * arc + 1e-6);
        }
    }
}

TEST(GeodesicBall, SettlesInOrderUntilToldToStop) {
    const TriangleMesh mesh = shapes::tube(20, 12, false);
    const GeodesicGraph graph(mesh);
    GeodesicBall ball(graph);
    const std::vector<double> all = distances(ball, 30, mesh.vertex_count());
    for (int round = 0; round < 2; ++round) {  // a ball can be used again
        double last = 0;
        int visited = 0;
        ball.grow(30, [&](int v, double d) {
            EXPECT_GE(d, last);
            EXPECT_EQ(d, all[std::size_t(v)]);
            last = d;
            return ++visited < 25;
        });
        EXPECT_EQ(visited, 25);
    }
}

}  // namespace
}  // namespace varimap
