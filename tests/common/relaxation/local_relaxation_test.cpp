#include "varimap/relaxation/local_relaxation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"

namespace varimap {
namespace {

/// A sphere onto itself with one vertex pushed aside.
struct Pushed {
    TriangleMesh mesh = shapes::ellipsoid(3, {1, 1, 1});
    SlidingMap map{shapes::at_vertices(mesh), mesh, mesh};
    int vertex = 20;
    VertexData<bool> awake = VertexData<bool>(mesh.vertex_count());
    std::vector<int> vertices = std::vector<int>(std::size_t(mesh.vertex_count()));

    Pushed() {
        map.move(vertex, 0.5 * map.longest_edge(vertex) * map.tangents(vertex).col(0));
        std::iota(vertices.begin(), vertices.end(), 0);
    }
    double off(int v) const { return (map.image(v) - map.target().vertex(v)).norm(); }
    void sweep() { LocalRelaxation(map, 99).sweep_awake(vertices, {1, 0.1}, awake); }
};

TEST(LocalRelaxation, LeavesVerticesThatSleep) {
    Pushed sphere;
    const double before = sphere.off(sphere.vertex);
    sphere.sweep();
    EXPECT_EQ(sphere.off(sphere.vertex), before);
}

TEST(LocalRelaxation, AVertexThatMovesWakesItsSurroundings) {
    Pushed sphere;
    const double before = sphere.off(sphere.vertex);
    sphere.awake[sphere.vertex] = true;
    for (int i = 0; i < 200; ++i) sphere.sweep();
    EXPECT_LT(sphere.off(sphere.vertex), before / 10);
    EXPECT_EQ(std::count(sphere.awake.begin(), sphere.awake.end(), 1), 0) << "nothing came to rest";
}

TEST(LocalRelaxation, WhatRestsWakesNobody) {
    Pushed sphere;
    sphere.map.place(sphere.vertex, shapes::at_vertices(sphere.mesh)[std::size_t(sphere.vertex)]);
    sphere.awake[sphere.vertex] = true;
    sphere.sweep();
    EXPECT_EQ(std::count(sphere.awake.begin(), sphere.awake.end(), 1), 0);
}

}  // namespace
}  // namespace varimap
