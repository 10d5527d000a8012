#include "varimap/sliding/branch_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "fixtures/bad_maps.h"
#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"
#include "varimap/mesh/closest_point.h"
#include "varimap/relaxation/local_relaxation.h"
#include "varimap/sliding/along_target.h"

namespace varimap {
namespace {

constexpr int pole = 3, opposite_pole = 0;

/// A sphere onto itself, each circle of latitude twice around.
SlidingMap doubled() {
    TriangleMesh mesh = shapes::ellipsoid(4);
    mesh.vertices =
        mesh.vertices *
        Eigen::Quaterniond::FromTwoVectors(mesh.vertex(pole), Vec3::UnitZ()).toRotationMatrix().transpose();
    const ClosestPoint closest(mesh);
    PointMap images;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const Vec3 p = mesh.vertex(v);
        const double angle = 2 * std::atan2(p.y(), p.x()), r = std::hypot(p.x(), p.y());
        images.push_back(closest(Vec3(r * std::cos(angle), r * std::sin(angle), p.z())).point);
    }
    return SlidingMap(images, mesh, mesh);
}

std::vector<int> all_vertices(const SlidingMap& map) {
    std::vector<int> all(std::size_t(map.source().vertex_count()));
    std::iota(all.begin(), all.end(), 0);
    return all;
}

TEST(BranchPoints, AreWhereAMapWindsTwice) {
    const SlidingMap map = doubled();
    EXPECT_EQ(winding_number(map, pole), 2);
    EXPECT_EQ(winding_number(map, 100), 1);
    EXPECT_EQ(branch_points(map, all_vertices(map)), (std::vector<int>{opposite_pole, pole}));
}

TEST(BranchPoints, AreTheSameAlongTheTarget) {
    const SlidingMap map = doubled();
    AlongTarget along_target(map);
    EXPECT_NEAR(along_target.winding_number(pole), 2, 1e-6);
    for (const int v : all_vertices(map))
        EXPECT_EQ(along_target.is_branch_point(v), v == pole || v == opposite_pole) << v;
    const AlongTarget::Faults faults = along_target.faults_around(pole);
    EXPECT_EQ(faults.branch_points, 1);
    EXPECT_EQ(faults.reversed, 0);
}

TEST(BranchPoints, AreNotSeenOnBoundaries) {
    const TriangleMesh square = shapes::square(4);
    const SlidingMap map(shapes::at_vertices(square), square, square);
    EXPECT_TRUE(branch_points(map, all_vertices(map)).empty());
    AlongTarget along_target(map);
    for (const int v : all_vertices(map)) EXPECT_FALSE(along_target.is_branch_point(v));
}

/// The vertex out of its star, which it would wind twice: some of its faces are reversed instead.
void take_pole_out(SlidingMap& map) {
    map.move(pole, 3 * map.longest_edge(pole) * map.tangents(pole).col(0));
    ASSERT_LT(winding_number(map, pole), 2);
}

TEST(BranchGuard, RefusesWhatMakesOne) {
    SlidingMap map = doubled();
    const SurfacePoint at_pole = map.point(pole);
    BranchGuard guard(map);
    guard.watch(pole);
    EXPECT_TRUE(guard.allows()) << "that was there before";
    take_pole_out(map);
    EXPECT_TRUE(guard.allows());
    guard.watch(pole);
    EXPECT_TRUE(guard.allows());
    map.place(pole, at_pole);
    EXPECT_FALSE(guard.allows());
    guard.rest();
    EXPECT_TRUE(guard.allows());
}

TEST(BranchGuard, KeepsLocalRelaxationFromMakingThem) {
    const TriangleMesh mesh = shapes::figure(0.1);
    SlidingMap map(shapes::noisy_identity(mesh, 4), mesh, mesh);
    LocalRelaxation local(map, 99);
    int moved = 0;
    for (const int v : all_vertices(map)) {
        const auto star = map.faces_of_vertex()[v];
        if (std::none_of(star.begin(), star.end(), [&](int f) { return map.image_triangle(f).D <= 0; }))
            continue;
        const std::vector<int> around = vertices_of(mesh, star);
        const std::size_t before = branch_points(map, around).size();
        const Vec3 image = map.image(v);
        std::vector<int> one{v};
        local.sweep(one, {1, 0.1});
        EXPECT_LE(branch_points(map, around).size(), before) << v;
        moved += map.image(v) != image;
    }
    EXPECT_GT(moved, 1000);
}

}  // namespace
}  // namespace varimap
