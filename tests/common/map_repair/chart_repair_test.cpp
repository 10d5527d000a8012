#include "varimap/map_repair/chart_repair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "fixtures/bad_maps.h"
#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"
#include "varimap/mesh/boundary.h"
#include "varimap/mesh/closest_point.h"
#include "varimap/mesh/subdivision.h"
#include "varimap/verification/verification.h"

namespace varimap {
namespace {

using shapes::none;

/// The identity, but the vertices near one are anywhere near it.
PointMap crumpled(const TriangleMesh& mesh, int centre, double radius) {
    std::mt19937 random(5);
    PointMap map = shapes::at_vertices(mesh);
    std::vector<int> near;
    for (int v = 0; v < mesh.vertex_count(); ++v)
        if ((mesh.vertex(v) - mesh.vertex(centre)).norm() < radius) near.push_back(v);
    const PointMap before = map;
    for (const int v : near) map[std::size_t(v)] = before[std::size_t(near[random() % near.size()])];
    return map;
}

/// What is left of a map's faults after repair.
/// `back`: the other direction; as it stands, it is not known.
Verification repaired(PointMap& images, const TriangleMesh& mesh, const VertexData<bool>& fixed,
                      const PointMap& back = {}) {
    SlidingMap map(images, mesh, mesh);
    AlongTarget along_target(map);
    NormalAgreement agreement(map, along_target);
    ChartRepair(map, along_target, agreement, back)(fixed);
    images = map.points();
    return verify_map(images, mesh, mesh);
}

TEST(LaidOut, TellsTheSidesOfAThinPlate) {
    const TriangleMesh plate = shapes::ellipsoid(3, {1, 1, 0.1});
    const LogMap log_map(plate);
    const auto sense = [&](const SurfacePoint& a, const SurfacePoint& b, const SurfacePoint& c) {
        return laid_out({log_map(a, b), log_map(b, c), log_map(c, a)}).sense;
    };
    const ClosestPoint closest(plate);
    const auto at = [&](double x, double y, double z) { return closest(Vec3(x, y, z)).point; };
    const SurfacePoint a = at(0.80, 0, 0.1), b = at(0.90, 0.1, 0.1);
    EXPECT_GT(sense(a, b, at(0.85, 0.2, 0.1)), 0.9);
    EXPECT_LT(sense(b, a, at(0.85, 0.2, 0.1)), -0.9);
    // The straight triangle looks the same if its last corner slips through to the other side; but from there
    // the others lie beyond the rim, on the other hand of it.
    EXPECT_LT(sense(a, b, at(0.85, 0.2, -0.1)), 0);
}

TEST(AlongTarget, FacesThatLieOverManyOfTheTargetAreNotTorn) {
    const TriangleMesh icosahedron = shapes::ellipsoid(0);
    TriangleMesh fine = icosahedron;
    for (int i = 0; i < 6; ++i) fine = subdivide(fine).mesh;
    PointMap images = shapes::at_vertices(fine);
    images.resize(std::size_t(icosahedron.vertex_count()));
    const SlidingMap map(images, icosahedron, fine);
    AlongTarget along_target(map);
    for (int f = 0; f < icosahedron.face_count(); ++f) EXPECT_FALSE(along_target.is_reversed(f)) << f;
}

TEST(ChartRepair, MapsACrumpledPatchAnew) {
    for (const TriangleMesh& mesh : {shapes::ellipsoid(4), shapes::torus(1, 0.4, 60, 30)}) {
        PointMap images = crumpled(mesh, 40, 0.25);
        const Verification before = verify_map(images, mesh, mesh);
        EXPECT_GT(before.reversed_faces.size(), 10u);
        const Verification after = repaired(images, mesh, none(mesh));
        EXPECT_TRUE(after.reversed_faces.empty()) << after.reversed_faces.size();
        EXPECT_TRUE(after.branch_vertices.empty()) << after.branch_vertices.size();
        EXPECT_EQ(after.degree.value(), 1);
        EXPECT_LT(shapes::mean_error(images, mesh), 0.3 * shapes::longest_edge(mesh));
    }
}

TEST(ChartRepair, MapsAFifthOfASurfaceAnewAndRelaxesIt) {
    const TriangleMesh mesh = shapes::ellipsoid(4);
    PointMap images = crumpled(mesh, 40, 0.85);
    EXPECT_GT(verify_map(images, mesh, mesh).reversed_faces.size(), 300u);
    const Verification after = repaired(images, mesh, none(mesh));
    EXPECT_TRUE(after.reversed_faces.empty()) << after.reversed_faces.size();
    EXPECT_TRUE(after.branch_vertices.empty()) << after.branch_vertices.size();
    // Local sweeps alone leave .5: a layout is no isometry.
    EXPECT_LT(shapes::mean_error(images, mesh), 0.1 * shapes::longest_edge(mesh));
}

TEST(ChartRepair, TakesAPartFromTheOtherDirection) {
    const TriangleMesh mesh = shapes::ellipsoid(4);
    const PointMap back = shapes::at_vertices(mesh);
    PointMap images = crumpled(mesh, 40, 0.25);
    SlidingMap map(images, mesh, mesh);
    AlongTarget along_target(map);
    NormalAgreement agreement(map, along_target);
    ChartRepair repair(map, along_target, agreement, back);
    repair(none(mesh));
    using enum ChartRepair::Outcome;
    EXPECT_GT(repair.report().outcomes[std::size_t(inverted)], 0);
    EXPECT_EQ(repair.report().outcomes[std::size_t(repaired)], 0) << "none was left for a chart";
    const Verification after = verify_map(map.points(), mesh, mesh);
    EXPECT_TRUE(after.reversed_faces.empty()) << after.reversed_faces.size();
    EXPECT_TRUE(after.branch_vertices.empty()) << after.branch_vertices.size();
}

/// A sphere with a thin limb, as long as four of its radii, towards `along`.
TriangleMesh with_limb(const TriangleMesh& sphere, const Vec3& along) {
    TriangleMesh mesh = sphere;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const double off = (sphere.vertex(v) - along).norm() / 0.25;
        if (off < 1) mesh.vertices.row(v) *= 1 + 4 * (1 - off);
    }
    return mesh;
}

TEST(ChartRepair, LeavesFaultsAtTheRootOfALimbRatherThanCrushIt) {
    // The target has its limb elsewhere. What surrounds the limb's root is mapped to where the target has
    // none, and so would a chart of both map the limb.
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.8, Vec3::UnitZ()).toRotationMatrix();
    const TriangleMesh sphere = shapes::ellipsoid(4), source = with_limb(sphere, Vec3::UnitX()),
                       target = with_limb(sphere, turn * Vec3::UnitX());
    const ClosestPoint closest(sphere);
    PointMap images;
    std::vector<int> limb;
    for (int v = 0; v < sphere.vertex_count(); ++v) {
        const bool on_limb = source.vertex(v).norm() > 1.001;
        if (on_limb) limb.push_back(v);
        images.push_back(closest(on_limb ? Vec3(turn * sphere.vertex(v)) : sphere.vertex(v)).point);
    }
    SlidingMap map(images, source, target);
    AlongTarget along_target(map);
    NormalAgreement agreement(map, along_target);
    const PointMap back;
    ChartRepair repair(map, along_target, agreement, back);
    EXPECT_GT(along_target.faulty_faces().size(), 10u);
    repair(none(source));
    double farthest = 0;
    for (const int v : limb) farthest = std::max(farthest, position(target, map.point(v)).norm());
    EXPECT_GT(farthest, 4);
}

TEST(ChartRepair, CrushesALimbThatHasNoPartner) {
    const TriangleMesh sphere = shapes::ellipsoid(4), source = with_limb(sphere, Vec3::UnitX());
    // The limb lies crumpled, in faces that are not small, where the target has none.
    int centre;
    sphere.vertices.col(0).maxCoeff(&centre);
    PointMap images = crumpled(sphere, centre, 0.25);
    EXPECT_GT(verify_map(images, source, sphere).reversed_faces.size(), 10u);
    SlidingMap map(images, source, sphere);
    AlongTarget along_target(map);
    NormalAgreement agreement(map, along_target);
    const PointMap back;
    ChartRepair(map, along_target, agreement, back)(none(source));
    const Verification after = verify_map(map.points(), source, sphere);
    EXPECT_TRUE(after.reversed_faces.empty()) << after.reversed_faces.size();
    EXPECT_TRUE(after.branch_vertices.empty()) << after.branch_vertices.size();
}

TEST(InverseMap, LeadsBackWhereTheOtherDirectionCameFrom) {
    const TriangleMesh sphere = shapes::ellipsoid(3);
    const PointMap there = shapes::turned_identity(sphere, 0.3), back = shapes::turned_identity(sphere, -0.3);
    const SlidingMap map(there, sphere, sphere);
    InverseMap inverse(map, back);
    double furthest = 0;
    for (int v = 0; v < sphere.vertex_count(); ++v)
        furthest = std::max(furthest,
                            (position(sphere, inverse(v)) - position(sphere, there[std::size_t(v)])).norm());
    EXPECT_LT(furthest, 0.2 * shapes::longest_edge(sphere));
    const PointMap nowhere(there.size()), unknown;
    InverseMap of_none(map, nowhere), of_unknown(map, unknown);
    EXPECT_LT(of_none(0).face, 0);
    EXPECT_LT(of_unknown(0).face, 0);
}

TEST(ChartRepair, DoesNoHarmAtABoundary) {
    const TriangleMesh square = shapes::square(20);
    const PointMap given = crumpled(square, 10, 0.2);  // on its boundary
    const std::size_t before = verify_map(given, square, square).reversed_faces.size();
    const VertexData<bool> rim = boundary_vertices(square, find_edges(square));
    for (const PointMap& back : {PointMap(), shapes::at_vertices(square)}) {
        PointMap images = given;
        EXPECT_LE(repaired(images, square, none(square), back).reversed_faces.size(), before);
        for (int v = 0; v < rim.size(); ++v) {
            if (!rim[v]) continue;
            EXPECT_EQ(images[std::size_t(v)].face, given[std::size_t(v)].face) << v;
            EXPECT_EQ(images[std::size_t(v)].barycentric, given[std::size_t(v)].barycentric) << v;
        }
    }
}

TEST(ChartRepair, LeavesAGoodMapAsItIs) {
    const TriangleMesh mesh = shapes::figure(0.15);
    const PointMap before = shapes::at_vertices(mesh);
    PointMap images = before;
    EXPECT_TRUE(repaired(images, mesh, none(mesh)).reversed_faces.empty());
    for (std::size_t v = 0; v < images.size(); ++v) {
        EXPECT_EQ(images[v].face, before[v].face);
        EXPECT_EQ(images[v].barycentric, before[v].barycentric);
    }
}

TEST(ChartRepair, KeepsFixedVertices) {
    const TriangleMesh mesh = shapes::ellipsoid(4);
    const PointMap before = crumpled(mesh, 40, 0.25);
    VertexData<bool> fixed = none(mesh);
    fixed[40] = true;
    PointMap images = before;
    repaired(images, mesh, fixed);
    EXPECT_EQ(images[40].face, before[40].face);
    EXPECT_EQ(images[40].barycentric, before[40].barycentric);
}

}  // namespace
}  // namespace varimap
