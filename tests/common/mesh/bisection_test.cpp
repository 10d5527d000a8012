#include "varimap/mesh/bisection.h"

#include <gtest/gtest.h>

#include <set>

#include "fixtures/shapes.h"
#include "varimap/mesh/manifold.h"
#include "varimap/mesh/topology.h"

namespace varimap {
namespace {

double longest_edge(const TriangleMesh& mesh) {
    double longest = 0;
    for (const auto& [a, b] : find_edges(mesh).vertices)
        longest = std::max(longest, (mesh.vertex(a) - mesh.vertex(b)).norm());
    return longest;
}

TEST(Bisection, SplitsOneTriangleAtItsLongestEdge) {
    const TriangleMesh mesh = shapes::make_mesh({{0, 0, 0}, {3, 0, 0}, {0, 2, 0}}, {{0, 1, 2}});
    const Bisection result = bisect_longest_edges(mesh, 3.1, 100);
    ASSERT_EQ(result.mesh.vertex_count(), 4);
    EXPECT_EQ(result.mesh.vertex(3), Vec3(1.5, 1, 0));
    EXPECT_EQ(result.mesh.face_count(), 2);
    EXPECT_EQ(result.on_origin[3].barycentric, Vec3(0, .5, .5));
}

TEST(Bisection, IsTheIdentityWhereNothingIsTooLong) {
    const TriangleMesh mesh = shapes::ellipsoid(2);
    const Bisection result = bisect_longest_edges(mesh, longest_edge(mesh), 100000);
    EXPECT_EQ(result.mesh.vertices, mesh.vertices);
    EXPECT_EQ(result.mesh.faces, mesh.faces);
}

class BisectionOf : public ::testing::TestWithParam<const char*> {
  protected:
    TriangleMesh mesh() const {
        const std::string name = GetParam();
        if (name == "ellipsoid") return shapes::ellipsoid(2, {1, 2, 4});
        if (name == "torus") return shapes::torus(2, .5, 40, 6);
        if (name == "square") return shapes::square(3);
        if (name == "open tube") return shapes::tube(4, 20, false);
        return shapes::figure(.15);
    }
};
INSTANTIATE_TEST_SUITE_P(Shapes, BisectionOf,
                         ::testing::Values("ellipsoid", "torus", "square", "open tube", "figure"));

TEST_P(BisectionOf, KeepsSurfaceAndTopologyAndReachesTheTarget) {
    const TriangleMesh before = mesh();
    const double target = longest_edge(before) / 5;
    const Bisection result = bisect_longest_edges(before, target, 1000000);
    EXPECT_NO_THROW(require_manifold(result.mesh, "bisected"));
    EXPECT_LE(longest_edge(result.mesh), target * (1 + 1e-9));
    EXPECT_NEAR(surface_area(result.mesh), surface_area(before), 1e-12 * surface_area(before));
    EXPECT_EQ(summarise_topology(result.mesh).genus, summarise_topology(before).genus);
    EXPECT_EQ(summarise_topology(result.mesh).boundary_loops, summarise_topology(before).boundary_loops);
    EXPECT_EQ(result.mesh.vertices.topRows(before.vertex_count()), before.vertices);
}

TEST_P(BisectionOf, EveryFaceAndVertexKnowsWhereItLies) {
    const TriangleMesh before = mesh();
    const Bisection result = bisect_longest_edges(before, longest_edge(before) / 5, 1000000);
    for (int v = 0; v < result.mesh.vertex_count(); ++v) {
        EXPECT_LT((position(before, result.on_origin[v]) - result.mesh.vertex(v)).norm(), 1e-14 * 4);
        EXPECT_EQ(result.on_origin[v].barycentric.sum(), 1);
    }
    Eigen::VectorXd area = Eigen::VectorXd::Zero(before.face_count());
    for (int f = 0; f < result.mesh.face_count(); ++f) {
        const int origin = result.origin[f];
        EXPECT_GT(face_normal(result.mesh, f).dot(face_normal(before, origin)), 0);
        area[origin] += face_normal(result.mesh, f).norm();
    }
    for (int f = 0; f < before.face_count(); ++f) EXPECT_NEAR(area[f], face_normal(before, f).norm(), 1e-12);
}

TEST_P(BisectionOf, DoesNotDependOnPlaceAndTurn) {
    const TriangleMesh before = mesh();
    const double target = longest_edge(before) / 5;
    const Bisection one = bisect_longest_edges(before, target, 1000000);
    const Bisection other =
        bisect_longest_edges(shapes::moved(before, 3, 1.1, {5, -7, 11}), 3 * target, 1000000);
    EXPECT_TRUE(one.mesh.faces == other.mesh.faces);
}

TEST(Bisection, DoesNotDependOnTheNumberingOfAnAsymmetricMesh) {
    const TriangleMesh before = shapes::moved(shapes::figure(.15), 1, .3, {0, 0, 0});
    std::vector<int> old_vertex;
    const TriangleMesh renumbered = shapes::shuffled(before, 3, &old_vertex);
    const double target = longest_edge(before) / 5;
    const auto points = [](const Bisection& b) {
        std::set<std::array<double, 3>> set;
        for (int v = 0; v < b.mesh.vertex_count(); ++v)
            set.insert({b.mesh.vertices(v, 0), b.mesh.vertices(v, 1), b.mesh.vertices(v, 2)});
        return set;
    };
    EXPECT_EQ(points(bisect_longest_edges(before, target, 1000000)),
              points(bisect_longest_edges(renumbered, target, 1000000)));
}

TEST(Bisection, ServesNeedlesAndFacesWithoutArea) {
    const TriangleMesh mesh =
        shapes::make_mesh({{0, 0, 0}, {1, 0, 0}, {.5, 0, 0}, {.5, 1e-9, 0}}, {{0, 1, 2}, {1, 0, 3}});
    const Bisection result = bisect_longest_edges(mesh, .01, 1000000);
    EXPECT_LE(longest_edge(result.mesh), .01 * (1 + 1e-9));
    EXPECT_LT(result.mesh.vertex_count(), 3000);
}

TEST(Bisection, EndsEarlyRatherThanExplode) {
    const Bisection ended = bisect_longest_edges(shapes::ellipsoid(1), 1e-4, 5000);
    EXPECT_EQ(ended.mesh.vertex_count(), 5000);
    EXPECT_NEAR(ended.longest_left, longest_edge(ended.mesh), 1e-3 * ended.longest_left);
    EXPECT_GT(ended.longest_left, 1e-4);
    const Bisection reached = bisect_longest_edges(shapes::ellipsoid(1), 10, 3);
    EXPECT_EQ(reached.longest_left, 0);
}

}  // namespace
}  // namespace varimap
