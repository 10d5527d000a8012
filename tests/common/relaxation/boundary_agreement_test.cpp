#include "varimap/relaxation/boundary_agreement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "fixtures/bad_maps.h"
#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"
#include "varimap/quality/quality.h"
#include "varimap/untangling/untangling.h"

namespace varimap {
namespace {

/// A sheet rolled about two axes, without stretching it, with waves along x.
TriangleMesh sheet(double phase) {
    TriangleMesh mesh = shapes::square(24);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const Vec3 p = mesh.vertex(v);
        mesh.vertices(v, 1) = std::sin(p.y());
        mesh.vertices(v, 2) = std::cos(p.y()) + 0.004 * std::sin(30 * p.x() + phase);
    }
    return mesh;
}

/// Points of the flat square scaled about its middle and moved along, as points of a target that is flat.
PointMap moved(const TriangleMesh& target, double scale, double shift) {
    const TriangleMesh flat = shapes::square(24);
    const ClosestPoint closest(target);
    PointMap map;
    for (int v = 0; v < flat.vertex_count(); ++v) {
        const Vec3 middle(0.5, 0.5, 0);
        map.push_back(closest(middle + scale * (flat.vertex(v) - middle) + shift * Vec3(1, 0.5, 0)).point);
    }
    return map;
}

TriangleMesh with_hole(TriangleMesh mesh, const Vec3& at, double radius) {
    int kept = 0;
    for (int f = 0; f < mesh.face_count(); ++f)
        if ((position(mesh, {f, Vec3::Constant(1.0 / 3)}) - at).norm() > radius)
            mesh.faces.row(kept++) = mesh.faces.row(f).eval();
    mesh.faces.conservativeResize(kept, 3);
    return mesh;
}

BoundaryAgreement matched(const SlidingMap& map) {
    BoundaryAgreement agreement(map);
    agreement.match();
    return agreement;
}

TEST(BoundaryAgreement, DrawsARimToTheOther) {
    const TriangleMesh mesh = shapes::square(24);
    const SlidingMap map(moved(mesh, 0.9, 0), mesh, mesh);
    const BoundaryAgreement agreement = matched(map);
    const std::vector<SoftConstraint> constraints = agreement.constraints(10);
    ASSERT_EQ(constraints.size(), 4 * 24);
    const auto [low, high] = bounding_box(map.target());
    double weight = 0;
    for (const SoftConstraint& constraint : constraints) {
        weight += constraint.weight;
        const Vec3 from_middle = constraint.to - (low + high) / 2;
        ASSERT_NEAR(from_middle.cwiseAbs().maxCoeff(), 0.5, 1e-9);
        ASSERT_NEAR((constraint.to - map.image(vertex_of(mesh, constraint.from))).norm(), 0.05, 1e-9);
    }
    EXPECT_NEAR(weight, 10 * 4, 1e-9);
}

TEST(BoundaryAgreement, LeavesAHoleThatOnlyOneHas) {
    const TriangleMesh mesh = shapes::square(24), holed = with_hole(mesh, {0.3, 0.3, 0}, 0.1);
    for (const auto& [source, target] : {std::pair(mesh, holed), std::pair(holed, mesh)}) {
        const SlidingMap map(moved(target, 0.95, 0), source, target);
        EXPECT_EQ(matched(map).constraints(1).size(), 4 * 24);
    }
}

TEST(BoundaryAgreement, TellsHolesApart) {
    const TriangleMesh mesh = shapes::square(24);
    const TriangleMesh here = with_hole(mesh, {0.3, 0.3, 0}, 0.1),
                       there = with_hole(mesh, {0.7, 0.7, 0}, 0.1);
    const SlidingMap same(shapes::at_vertices(here), here, here);
    EXPECT_GT(matched(same).constraints(1).size(), 4 * 24);
    const SlidingMap apart(moved(there, 1, 0), here, there);
    EXPECT_EQ(matched(apart).constraints(1).size(), 4 * 24);
}

TEST(BoundaryAgreement, IsNothingOnClosedSurfaces) {
    const TriangleMesh sphere = shapes::ellipsoid(2);
    const SlidingMap map(shapes::at_vertices(sphere), sphere, sphere);
    EXPECT_TRUE(matched(map).constraints(1).empty());
}

struct Found {
    double error, coverage;
};

Found untangled(const TriangleMesh& A, const TriangleMesh& B, const UntanglingOptions& options) {
    // The sheets' faces are those of the flat one.
    MapPair maps{moved(shapes::square(24), 0.95, 0.03), moved(shapes::square(24), 0.95, -0.03)};
    const VertexData<bool> pinned(A.vertex_count());
    untangle(maps, A, B, {pinned, pinned}, options);
    return {shapes::mean_error(maps.A_to_B, B), measure_coverage(maps.A_to_B, A, B).share};
}

/// Without, both directions leave a margin out, each held by the other.
TEST(BoundaryAgreement, BringsSheetsIntoPlace) {
    const TriangleMesh A = sheet(0), B = sheet(0);
    UntanglingOptions options;
    options.relief_weight = 0;
    const Found with = untangled(A, B, options);
    options.boundary_weight = 0;
    const Found without = untangled(A, B, options);
    EXPECT_LT(with.error, 0.003);
    EXPECT_GT(without.error, 3 * with.error);
    EXPECT_GT(with.coverage, 0.999);
}

/// Waves that are elsewhere on the other sheet say nothing about where its points are.
TEST(WeighedRelief, DoesNotFollowWavesThatDisagree) {
    const TriangleMesh A = sheet(0), B = sheet(2);
    UntanglingOptions options;
    const Found weighed = untangled(A, B, options);
    options.weigh_relief = false;
    const Found followed = untangled(A, B, options);
    EXPECT_LT(weighed.error, 0.005);
    EXPECT_GT(followed.error, 2 * weighed.error);
}

}  // namespace
}  // namespace varimap
