#include "varimap/mesh/interpolation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "fixtures/shapes.h"
#include "varimap/mesh/topology.h"

namespace varimap {
namespace {

const SurfacePoint between{3, Vec3(.5, .3, .2)}, on_edge{3, Vec3(.25, 0, .75)};

TEST(WeightedCorners, LeaveOutThoseThatDoNotCount) {
    const TriangleMesh mesh = shapes::square(2);
    std::vector<int> vertices;
    for (const auto [vertex, weight] : WeightedCorners(mesh, on_edge)) vertices.push_back(vertex);
    EXPECT_EQ(vertices, (std::vector<int>{mesh.faces(3, 0), mesh.faces(3, 2)}));
}

TEST(Interpolation, IsLinearOnFaces) {
    const TriangleMesh mesh = shapes::square(2);
    const Eigen::VectorXd x = mesh.vertices.col(0);
    EXPECT_NEAR(interpolated(x, mesh, between), position(mesh, between).x(), 1e-15);
    const Points at = positions(mesh, {between, on_edge});
    EXPECT_LT((at.row(0).transpose() - position(mesh, between)).norm(), 1e-15);
    EXPECT_LT((at.row(1).transpose() - position(mesh, on_edge)).norm(), 1e-15);
}

TEST(Interpolation, AsksNothingOfCornersThatDoNotCount) {
    const TriangleMesh mesh = shapes::square(2);
    Eigen::VectorXd x = mesh.vertices.col(0);
    x[mesh.faces(3, 1)] = std::nan("");
    EXPECT_NEAR(interpolated(x, mesh, on_edge), position(mesh, on_edge).x(), 1e-15);
}

TEST(StraightImage, IsThePointItselfUnderTheIdentity) {
    const TriangleMesh mesh = shapes::square(2);
    const StraightImage image = straight_image(between, points_at_vertices(mesh), mesh, mesh);
    EXPECT_LT((image.place - position(mesh, between)).norm(), 1e-15);
    EXPECT_LT((image.normal - face_normal(mesh, 3).normalized()).norm(), 1e-15);
    EXPECT_NEAR(image.share, 1, 1e-15);
    EXPECT_TRUE(image.is_whole);
}

TEST(StraightImage, TellsWhatItLacks) {
    const TriangleMesh mesh = shapes::square(2);
    PointMap map = points_at_vertices(mesh);
    map[std::size_t(mesh.faces(3, 1))] = {};
    const StraightImage part = straight_image(between, map, mesh, mesh);
    EXPECT_FALSE(part.is_whole);
    EXPECT_NEAR(part.share, .7, 1e-15);
    EXPECT_TRUE(straight_image(on_edge, map, mesh, mesh).is_whole);
}

}  // namespace
}  // namespace varimap
