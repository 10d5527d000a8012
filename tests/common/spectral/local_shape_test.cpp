#include "varimap/spectral/local_shape.h"

#include <gtest/gtest.h>

#include "fixtures/known_pair.h"
#include "fixtures/surface_data.h"
#include "varimap/mesh/boundary.h"
#include "varimap/mesh/topology.h"

namespace varimap {
namespace {

SurfaceData sphere() {
    return shapes::surface_data(shapes::unit_surface(shapes::ellipsoid(4)), 60);
}

SurfaceData figure() {
    return shapes::figure_pair(1, false).A;
}

Points outward_normals(const Surface& surface) {
    return varimap::outward_normals(surface.mesh, is_inward(surface));
}

Eigen::VectorXd bending(const SurfaceData& data) {
    return varimap::bending(data.surface, outward_normals(data.surface), data.basis, 4e-3);
}

Eigen::VectorXd shape_diameter(const Surface& surface) {
    return varimap::shape_diameter(surface.mesh, outward_normals(surface));
}

RowMatrix descriptors(const SurfaceData& data) {
    return local_shape(data.surface, data.basis).descriptors;
}

/// As scanners leave it, watertight or not.
Surface inside_out(const TriangleMesh& mesh) {
    Surface surface = with_reversed_orientation(shapes::unit_surface(mesh));
    surface.mirrored = false;
    return surface;
}

bool are_opposed(const Surface& A, const Surface& B) {
    return PairHandedness(A, B).are_opposite();
}

TEST(PairHandedness, IsAskedOfBothSurfaces) {
    const Surface closed = shapes::unit_surface(shapes::tube(12, 8, true)),
                  open = shapes::unit_surface(shapes::tube(12, 8, false));
    const Surface closed_inside = inside_out(closed.mesh), open_inside = inside_out(open.mesh);
    EXPECT_FALSE(are_opposed(closed, closed));
    EXPECT_FALSE(are_opposed(closed_inside, closed_inside));
    EXPECT_TRUE(are_opposed(closed_inside, closed));
    EXPECT_FALSE(are_opposed(closed, open));
    EXPECT_FALSE(are_opposed(closed_inside, open_inside)) << "of the same scanner";
    EXPECT_FALSE(are_opposed(open_inside, closed_inside));
    EXPECT_TRUE(PairHandedness(open_inside, closed_inside).A_inward);
    const Surface closed_image = with_reversed_orientation(closed),
                  open_image = with_reversed_orientation(open);
    for (const Surface& other : {closed, open}) {
        EXPECT_TRUE(are_opposed(closed_image, other)) << "a mirror image is asked for";
        EXPECT_TRUE(are_opposed(other, open_image));
    }
    EXPECT_FALSE(are_opposed(with_reversed_orientation(closed_inside), open)) << "set right by --mirror";
    ASSERT_NE(orientation_sign(open.mesh), 0);
    EXPECT_TRUE(are_opposed(open, open_inside));
    EXPECT_FALSE(are_opposed(with_reversed_orientation(open), open_inside)) << "the same";
}

TEST(Bending, IsPositiveOnRidgesAndKeptByMirroring) {
    SurfaceData data = figure();
    const Eigen::VectorXd plain = bending(data);
    const TriangleMesh& mesh = data.surface.mesh;
    int tip;  // of the tail, the hindmost vertex
    mesh.vertices.col(0).minCoeff(&tip);
    EXPECT_GT(plain[tip], 2 * plain.cwiseAbs().mean());
    data.surface = with_reversed_orientation(std::move(data.surface));
    EXPECT_LT((bending(data) - plain).norm(), 1e-9 * plain.norm());
}

TEST(ShapeDiameter, IsTheLengthOfChordsOfASphere) {
    // The cone's rays hit a sphere of radius r at 2 r cos(angle from the normal): tan = 0.5, so cos = 2 /
    // sqrt(5).
    const Eigen::VectorXd through = shape_diameter(sphere().surface);
    const double diameter = 1 / std::sqrt(M_PI), expected = diameter * (1 + 3 * 2 / std::sqrt(5)) / 4;
    EXPECT_NEAR(through.mean(), expected, .01 * expected);
    EXPECT_LT((through.array() - expected).abs().maxCoeff(), .03 * expected);
}

TEST(ShapeDiameter, IsThatOfTheLongestRayWhereNothingLiesOpposite) {
    EXPECT_NEAR(shape_diameter(shapes::unit_surface(shapes::square(8))).minCoeff(), .6, 1e-3);
}

TEST(ShapeDiameter, IsThatOfTheLongestRayWhereThereIsNoNormal) {
    Surface surface = sphere().surface;
    TriangleMesh& mesh = surface.mesh;
    const Adjacency neighbours = vertex_neighbours(mesh);
    for (const int v : neighbours[0]) mesh.vertices.row(v) = mesh.vertices.row(0).eval();
    const Eigen::VectorXd through = shape_diameter(surface);
    EXPECT_TRUE(through.allFinite());
    EXPECT_NEAR(through[0], .6, 1e-3);
    EXPECT_LT(through[neighbours[0][0]], .6);  // has other faces
}

TEST(LocalShape, IsNearlyZeroWhereAllPlacesAreAlike) {
    EXPECT_LT(descriptors(sphere()).cwiseAbs().maxCoeff(), .1);
    const SurfaceData square = shapes::surface_data(shapes::unit_surface(shapes::square(12)), 60);
    EXPECT_LT(descriptors(square).cwiseAbs().maxCoeff(), .1);
}

TEST(LocalShape, IsKeptByMotionsAndMirroring) {
    SurfaceData data = figure();
    const RowMatrix plain = descriptors(data);
    EXPECT_GT(plain.rowwise().squaredNorm().mean(), .2);  // there is something to compare
    const Eigen::AngleAxisd turn(1, Vec3(1, 2, 3).normalized());
    data.surface.mesh.vertices = (data.surface.mesh.vertices * turn.toRotationMatrix().transpose()).eval();
    data.surface = with_reversed_orientation(std::move(data.surface));
    // Rays in other directions around the normal measure other diameters.
    EXPECT_LT((descriptors(data) - plain).leftCols(2).norm(), 1e-6 * plain.norm());
    EXPECT_LT((descriptors(data) - plain).norm(), .2 * plain.norm());
}

}  // namespace
}  // namespace varimap
