#include "varimap/mesh/coarsening.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fixtures/shapes.h"
#include "varimap/mesh/manifold.h"
#include "varimap/mesh/topology.h"

namespace varimap {
namespace {

/// Largest distance of a vertex from its place on the coarse mesh.
double farthest(const TriangleMesh& mesh, const Coarsening& coarse) {
    double largest = 0;
    for (int v = 0; v < mesh.vertex_count(); ++v)
        largest = std::max(largest, (position(coarse.mesh, coarse.on_mesh[v]) - mesh.vertex(v)).norm());
    return largest;
}

/// Area on the coarse mesh, signed by its normals, of the faces all of whose corners have places on one of
/// its faces; `count` of them, `reversed` of these.
struct Placed {
    int count = 0, reversed = 0;
};
Placed placed_faces(const TriangleMesh& mesh, const Coarsening& coarse) {
    Placed placed;
    for (int f = 0; f < mesh.face_count(); ++f) {
        Eigen::Matrix3d corners;
        bool one = true;
        for (int k = 0; k < 3; ++k) {
            const SurfacePoint& at = coarse.on_mesh[mesh.faces(f, k)];
            corners.col(k) = at.barycentric;
            one = one && at.face == coarse.on_mesh[mesh.faces(f, 0)].face;
        }
        placed.count += one;
        placed.reversed += one && corners.determinant() < 0;
    }
    return placed;
}

TEST(Coarsen, KeepsShapeTopologyAndSomeOfTheVertices) {
    const TriangleMesh mesh = shapes::figure(.1);
    const Coarsening coarse = coarsen(mesh, 1000);
    EXPECT_EQ(coarse.mesh.vertex_count(), 1000);
    EXPECT_NO_THROW(require_manifold(coarse.mesh, "coarse"));
    EXPECT_EQ(summarise_topology(coarse.mesh).genus, summarise_topology(mesh).genus);
    EXPECT_TRUE(std::is_sorted(coarse.vertex.begin(), coarse.vertex.end()));
    for (int v = 0; v < coarse.mesh.vertex_count(); ++v) {
        EXPECT_EQ(coarse.mesh.vertex(v), mesh.vertex(coarse.vertex[v]));
        EXPECT_EQ(vertex_of(coarse.mesh, coarse.on_mesh[coarse.vertex[v]]), v);
    }
    EXPECT_NEAR(surface_area(coarse.mesh) / surface_area(mesh), 1, .03);
    for (int f = 0; f < coarse.mesh.face_count(); ++f) EXPECT_GT(face_normal(coarse.mesh, f).norm(), 0);
}

TEST(Coarsen, PutsEveryVertexOnTheCoarseMeshOneToOne) {
    const TriangleMesh mesh = shapes::figure(.1);
    const Coarsening coarse = coarsen(mesh, 800);
    ASSERT_EQ(int(coarse.on_mesh.size()), mesh.vertex_count());
    EXPECT_TRUE(are_points(coarse.on_mesh, coarse.mesh.face_count()));
    EXPECT_LT(farthest(mesh, coarse), .2) << "in a figure about 4 long; its edges are .1 and then .3";
    const Placed placed = placed_faces(mesh, coarse);
    EXPECT_GT(placed.count, mesh.face_count() / 6);
    EXPECT_LT(placed.reversed, placed.count / 500)
        << "whose corners are one to one, but not linear between them";
}

TEST(Coarsen, IsExactOnAPlane) {
    const TriangleMesh square = shapes::square(20);
    const Coarsening coarse = coarsen(square, 60);
    EXPECT_EQ(coarse.mesh.vertex_count(), 60);
    EXPECT_NEAR(surface_area(coarse.mesh), 1, 1e-12) << "corners and sides stay";
    EXPECT_EQ(summarise_topology(coarse.mesh).boundary_loops, 1);
    EXPECT_LT(farthest(square, coarse), 1e-12) << "all discs are flat already";
}

/// As where marching cubes cut a plane: between lines at distances of 1 and 49 by turns every vertex has thin
/// faces, and any that goes makes one a little thinner.
TEST(Coarsen, LeavesNoVerticesWhereAllFacesAreThin) {
    constexpr int lines = 40;
    TriangleMesh square = shapes::square(lines);
    for (double& x : square.vertices.leftCols(2).reshaped()) {
        const int line = int(std::lround(x * lines));
        if (line % 2 == 1) x = (line - 1 + .04) / lines;
    }
    const Coarsening coarse = coarsen(square, 200);
    EXPECT_EQ(coarse.mesh.vertex_count(), 200);
    EXPECT_EQ(summarise_topology(coarse.mesh).boundary_loops, 1);
    EXPECT_NEAR(surface_area(coarse.mesh), 1, .01);
}

TEST(Coarsen, KeepsBoundariesAndHandles) {
    for (const auto& [mesh, vertices] :
         {std::pair{shapes::tube(60, 20, false), 150}, std::pair{shapes::torus(1, .4, 60, 30), 200}}) {
        const Coarsening coarse = coarsen(mesh, vertices);
        const TopologySummary before = summarise_topology(mesh), after = summarise_topology(coarse.mesh);
        EXPECT_EQ(coarse.mesh.vertex_count(), vertices);
        EXPECT_EQ(after.genus, before.genus);
        EXPECT_EQ(after.boundary_loops, before.boundary_loops);
        EXPECT_NO_THROW(require_manifold(coarse.mesh, "coarse"));
    }
}

TEST(Coarsen, EndsWhereNothingMoreCanGo) {
    const TriangleMesh sphere = shapes::ellipsoid(2);
    const Coarsening coarse = coarsen(sphere, 1);
    EXPECT_GE(coarse.mesh.vertex_count(), 4);
    EXPECT_LT(coarse.mesh.vertex_count(), 30);
    EXPECT_NO_THROW(require_manifold(coarse.mesh, "coarse"));
    EXPECT_TRUE(are_points(coarse.on_mesh, coarse.mesh.face_count()));
}

TEST(Coarsen, LeavesAMeshOfFewVerticesAsItIs) {
    const TriangleMesh sphere = shapes::ellipsoid(1);
    const Coarsening coarse = coarsen(sphere, 100);
    EXPECT_EQ(coarse.mesh.vertices, sphere.vertices);
    EXPECT_EQ(coarse.mesh.faces, sphere.faces);
}

TEST(Coarsen, KeepsMoreOfWhatWouldLoseItsArea) {
    TriangleMesh waves = shapes::square(60);
    for (int v = 0; v < waves.vertex_count(); ++v)
        waves.vertices(v, 2) = .05 * std::sin(40 * waves.vertices(v, 0));
    const double area = surface_area(waves);
    EXPECT_LT(surface_area(coarsen(waves, 30).mesh), .9 * area);
    const Coarsening kept = coarsen(waves, 30, {}, {1000, .05});
    EXPECT_NEAR(surface_area(kept.mesh) / area, .95, .003);
    EXPECT_GT(kept.mesh.vertex_count(), 100);
    EXPECT_LT(kept.mesh.vertex_count(), 1000);
    EXPECT_EQ(coarsen(waves, 30, {}, {100, .05}).mesh.vertex_count(), 100);
    const TriangleMesh figure = shapes::figure(.15);
    EXPECT_EQ(coarsen(figure, 700, {}, {2000, .05}).vertex, coarsen(figure, 700).vertex);
}

TEST(Coarsen, DoesNotDependOnPlaceAndScale) {
    const TriangleMesh mesh = shapes::figure(.15);
    const Coarsening plain = coarsen(mesh, 700);
    TriangleMesh larger = mesh;
    larger.vertices *= 8;
    EXPECT_EQ(coarsen(larger, 700).vertex, plain.vertex);
    const Coarsening moved = coarsen(shapes::moved(mesh, 30, 1, {4, 5, 6}), 700);
    std::vector<int> different;
    std::set_symmetric_difference(moved.vertex.begin(), moved.vertex.end(), plain.vertex.begin(),
                                  plain.vertex.end(), std::back_inserter(different));
    EXPECT_LE(different.size(), 14u)
        << "1%: the figure's sides are alike, and rounding may tell which goes first";
}

}  // namespace
}  // namespace varimap
