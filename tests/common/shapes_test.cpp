#include "common/shapes.h"

#include <gtest/gtest.h>

#include "common/mesh/closest_point.h"
#include "common/mesh/mesh_file.h"
#include "common/mesh/topology.h"

namespace varimap {
namespace {

/// Largest distance of the vertices of one mesh from the other.
double distance(const TriangleMesh& from, const TriangleMesh& to) {
    const ClosestPoint closest(to);
    double largest = 0;
    for (int v = 0; v < from.vertex_count(); ++v)
        largest = std::max(largest, std::sqrt(closest(from.vertex(v)).squared_distance));
    return largest;
}

TEST(Shapes, AreManifoldWithTheStatedTopology) {
    const struct {
        const char* name;
        TriangleMesh mesh;
        int genus, boundary_loops;
    } cases[] = {{"ellipsoid", shapes::ellipsoid(2, {1, 2, 3}), 0, 0},
                 {"torus", shapes::torus(2, .5, 20, 9), 1, 0},
                 {"square", shapes::square(4), 0, 1},
                 {"tube", shapes::tube(20, 12, true), 0, 0},
                 {"open tube", shapes::tube(20, 12, false), 0, 2},
                 {"figure", shapes::figure(.15), 0, 0}};
    for (const auto& shape : cases) {
        SCOPED_TRACE(shape.name);
        EXPECT_NO_THROW(require_manifold(shape.mesh, shape.name));
        const TopologySummary topology = summarise_topology(shape.mesh);
        EXPECT_EQ(topology.genus, shape.genus);
        EXPECT_EQ(topology.boundary_loops, shape.boundary_loops);
        EXPECT_TRUE(shape.boundary_loops > 0 || signed_volume(shape.mesh) > 0);
    }
}

TEST(Shapes, PosesAreInvertible) {
    for (const auto& [rest, pose] : {std::pair{shapes::figure(.15), shapes::figure_pose(1)},
                                     std::pair{shapes::tube(20, 12, true), shapes::tube_pose(-1.2)},
                                     std::pair{shapes::tube(20, 12, true), shapes::tube_pose(1.2)}}) {
        const TriangleMesh posed = pose(rest);
        EXPECT_NO_THROW(require_manifold(posed, "posed"));
        EXPECT_GT((posed.vertices - rest.vertices).rowwise().norm().maxCoeff(), .3);
        for (int v = 0; v < rest.vertex_count(); ++v)
            EXPECT_LT((pose.inverse(posed.vertex(v)) - rest.vertex(v)).norm(), 1e-12);
    }
}

TEST(Shapes, ThePosedFigureIsNearlyIsometric) {
    const TriangleMesh rest = shapes::figure(.15), posed = shapes::figure_pose(1)(rest);
    EXPECT_NEAR(surface_area(posed) / surface_area(rest), 1, .02);
    int strained = 0;
    const Edges edges = find_edges(rest);
    for (const auto& [a, b] : edges.vertices) {
        const double ratio =
            (posed.vertex(a) - posed.vertex(b)).norm() / (rest.vertex(a) - rest.vertex(b)).norm();
        strained += ratio < .75 || ratio > 1.33;
    }
    EXPECT_LT(strained, edges.size() / 50);
}

TEST(Shapes, TessellationsOfOneSurfaceAreClose) {
    EXPECT_LT(distance(shapes::figure(.1, .5), shapes::figure(.08)), .04);
    EXPECT_LT(distance(shapes::tube(50, 24, true, .3), shapes::tube(60, 29, true)), .015);
}

}  // namespace
}  // namespace varimap
