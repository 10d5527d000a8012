#include "varimap/results/read_out.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"
#include "fixtures/sphere_pair.h"
#include "varimap/core/error.h"

namespace varimap {
namespace {

using shapes::identity_plan;
using shapes::plain_surface;

/// A sphere pressed to a thin sheet with an upper and a lower side.
Surface sheet(double thickness) {
    TriangleMesh mesh = shapes::ellipsoid(2);
    mesh.vertices.col(2) *= thickness / 2;
    return plain_surface(mesh);
}

/// The vertex nearest to the middle of one side of a sheet.
int top(const Surface& surface, double side) {
    int v = 0;
    (side * surface.mesh.vertices.col(2)).maxCoeff(&v);
    return v;
}

double largest_distance(const PointMap& map, const Surface& target, const Points& expected) {
    double largest = 0;
    for (std::size_t i = 0; i < map.size(); ++i)
        largest =
            std::max(largest, (position(target.mesh, map[i]) - expected.row(int(i)).transpose()).norm());
    return largest;
}

TEST(ReadOut, IdentityGoesToItself) {
    const Surface surface = plain_surface(shapes::ellipsoid(2));
    Plan plan = identity_plan(surface);
    MapPair maps = read_out(plan, surface, surface);
    EXPECT_LT(largest_distance(maps.A_to_B, surface, surface.mesh.vertices), 1e-12);
    EXPECT_LT(largest_distance(maps.B_to_A, surface, surface.mesh.vertices), 1e-12);
    plan.plan.samples_A.pop_back();  // no longer all vertices: closest points of the whole mesh
    plan.plan.entries.conservativeResize(int(plan.plan.samples_A.size()), plan.plan.entries.cols());
    maps = read_out(plan, surface, surface);
    EXPECT_LT(largest_distance(maps.A_to_B, surface, surface.mesh.vertices), 1e-12);
}

TEST(ReadOut, StaysOnTheSupportOfTheRow) {
    const Surface surface = sheet(0.1);
    Plan plan = identity_plan(surface);
    plan.centre_A.col(2) *= -1;  // every centre lies exactly on the wrong side
    const MapPair maps = read_out(plan, surface, surface);
    const int v = top(surface, 1);
    EXPECT_GT(position(surface.mesh, maps.A_to_B[std::size_t(v)])[2], 0);
}

TEST(ReadOut, UsesTheTransposeForTheWayBack) {
    const Surface surface = sheet(0.1);
    Plan plan = identity_plan(surface);
    const int up = top(surface, 1), down = top(surface, -1);
    plan.plan.entries.coeffRef(up, up) = plan.plan.entries.coeffRef(down, down) = 0;
    plan.plan.entries.coeffRef(up, down) =
        1;  // the row of `up` is supported below, the column of `up` is empty
    plan.centre_A.row(up) *= 0;
    plan.centre_B.row(down) *= 0;
    const MapPair maps = read_out(plan, surface, surface);
    EXPECT_LT(position(surface.mesh, maps.A_to_B[std::size_t(up)])[2], -0.04);
    EXPECT_GT(position(surface.mesh, maps.B_to_A[std::size_t(down)])[2], 0.04);
}

TEST(ReadOut, IgnoresFaintEntries) {
    const Surface surface = sheet(0.1);
    Plan plan = identity_plan(surface);
    const int up = top(surface, 1), down = top(surface, -1);
    plan.plan.entries.coeffRef(up, down) = 0.04;
    plan.centre_A.row(up) = surface.mesh.vertices.row(down);
    const MapPair maps = read_out(plan, surface, surface);
    EXPECT_GT(position(surface.mesh, maps.A_to_B[std::size_t(up)])[2], 0);
}

TEST(ReadOut, TakesTheSideWithMostOfTheMass) {
    const Surface surface = sheet(0.1);
    Plan plan = identity_plan(surface);
    const int up = top(surface, 1), down = top(surface, -1);
    plan.plan.entries.coeffRef(up, up) = 0.7;
    plan.plan.entries.coeffRef(up, down) = 0.3;
    plan.centre_A.row(up) *= -0.2;  // a little nearer to the lower side
    const MapPair maps = read_out(plan, surface, surface);
    EXPECT_GT(position(surface.mesh, maps.A_to_B[std::size_t(up)])[2], 0);
}

TEST(ReadOut, OfAnIncompletePlanKeepsTheSidesApart) {
    const Surface surface = sheet(0.1);
    Plan plan = identity_plan(surface);
    plan.plan.samples_A.pop_back();
    plan.plan.entries.conservativeResize(int(plan.plan.samples_A.size()), plan.plan.entries.cols());
    plan.centre_A *= 0.5;                  // shrunken centres,
    plan.centre_A.col(2).array() -= 0.01;  // those of the upper side nearer to the lower one in part
    const MapPair maps = read_out(plan, surface, surface);
    for (int v = 0; v < surface.mesh.vertex_count(); ++v)
        if (std::abs(surface.mesh.vertices(v, 2)) > 0.01) {
            const double z = position(surface.mesh, maps.A_to_B[std::size_t(v)])[2];
            EXPECT_GT(z * surface.mesh.vertices(v, 2), 0) << "vertex " << v;
        }
}

TEST(ReadOut, FallsBackWhereARowIsEmpty) {
    const Surface surface = plain_surface(shapes::ellipsoid(2));
    Plan plan = identity_plan(surface);
    plan.plan.entries.coeffRef(3, 3) = 0;
    plan.plan.entries.prune(0.0);
    const MapPair maps = read_out(plan, surface, surface);
    EXPECT_LT(largest_distance(maps.A_to_B, surface, surface.mesh.vertices), 1e-12);
}

TEST(ReadOut, LandmarksAreExact) {
    const Surface surface = plain_surface(shapes::ellipsoid(2));
    Plan plan = identity_plan(surface);
    plan.record.landmarks = {{{5}, {40}}};
    const MapPair maps = read_out(plan, surface, surface);
    EXPECT_EQ(position(surface.mesh, maps.A_to_B[5]), surface.mesh.vertex(40));
    EXPECT_EQ(position(surface.mesh, maps.B_to_A[40]), surface.mesh.vertex(5));
}

TEST(ReadOut, OfADiffusionIsAtItsImageVertices) {
    const Surface surface = plain_surface(shapes::ellipsoid(2));
    const int n = surface.mesh.vertex_count();
    Diffusion diffusion;
    for (int v = 0; v < n; ++v) diffusion.image_vertex_A.push_back(n - 1 - v);
    diffusion.image_vertex_B = diffusion.image_vertex_A;
    diffusion.record.landmarks = {{{5}, {40}}};
    const MapPair maps = read_out(diffusion, surface, surface);
    for (int v = 0; v < n; ++v)
        EXPECT_EQ(position(surface.mesh, maps.A_to_B[std::size_t(v)]),
                  surface.mesh.vertex(v == 5 ? 40 : n - 1 - v));
    EXPECT_EQ(position(surface.mesh, maps.B_to_A[40]), surface.mesh.vertex(5));
}

TEST(ReadOut, RefusesAPlanOfOtherSurfaces) {
    const Surface surface = plain_surface(shapes::ellipsoid(2)), other = plain_surface(shapes::ellipsoid(1));
    EXPECT_THROW(read_out(identity_plan(surface), surface, other), ArtifactError);
    Diffusion diffusion;
    diffusion.image_vertex_A = diffusion.image_vertex_B = {0, 1};
    EXPECT_THROW(read_out(diffusion, surface, surface), ArtifactError);
}

}  // namespace
}  // namespace varimap
