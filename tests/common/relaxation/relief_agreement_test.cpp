#include "varimap/relaxation/relief_agreement.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fixtures/bad_maps.h"
#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"
#include "varimap/untangling/untangling.h"

namespace varimap {
namespace {

using shapes::mean_error;

/// A sphere with bumps, which an isometry's energy hardly keeps from turning.
TriangleMesh bumpy_sphere() {
    TriangleMesh mesh = shapes::ellipsoid(4);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const Vec3 p = mesh.vertex(v);
        mesh.vertices.row(v) *=
            1 + 0.03 * std::sin(6 * p.x() + 1) * std::sin(5 * p.y()) * std::cos(4 * p.z());
    }
    return mesh;
}

TEST(Relief, IsHighOnBumpsAndLowInDents) {
    const TriangleMesh sphere = shapes::ellipsoid(4), bumpy = bumpy_sphere();
    const Eigen::VectorXd height = bumpy.vertices.rowwise().norm() - sphere.vertices.rowwise().norm();
    TriangleMesh unit = bumpy;
    unit.vertices /= std::sqrt(surface_area(bumpy));
    const Eigen::VectorXd h = reliefs(unit, {0.04})[0];
    EXPECT_LE(h.cwiseAbs().maxCoeff(), 2);
    const Eigen::VectorXd a = h.array() - h.mean(), b = height.array() - height.mean();
    EXPECT_GT(a.dot(b) / (a.norm() * b.norm()), 0.9);
}

TEST(Relief, IsNotThatOfVerticesThatNoFaceUses) {
    const TriangleMesh bumpy = bumpy_sphere();
    TriangleMesh with_more = bumpy;
    with_more.vertices.conservativeResize(3 * bumpy.vertex_count(), 3);
    with_more.vertices.bottomRows(2 * bumpy.vertex_count()).setConstant(.5);
    const Eigen::VectorXd h = reliefs(bumpy, {0.04})[0];
    EXPECT_GT(h.cwiseAbs().maxCoeff(), 1);
    EXPECT_LT((reliefs(with_more, {0.04})[0].head(h.size()) - h).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(ReliefAgreement, KnowsSurfacesOfOppositeHandedness) {
    const TriangleMesh outward = bumpy_sphere();
    TriangleMesh inward = outward;
    inward.faces.col(1).swap(inward.faces.col(2));
    SlidingMap map(shapes::at_vertices(outward), inward, outward);
    const auto total = [&](bool opposed) {
        const ReliefAgreement agreement(map, 1, relief_pairs(inward, outward, opposed));
        double sum = 0;
        for (int v = 0; v < outward.vertex_count(); ++v) sum += agreement.value(v);
        return sum;
    };
    EXPECT_GT(total(false), 0.01);
    EXPECT_LT(total(true), 1e-4 * total(false));  // the upper median of an even number is turned, too
}

TEST(ReliefAgreement, HasTheDerivativesOfItsValue) {
    const TriangleMesh mesh = bumpy_sphere();
    SlidingMap map(shapes::turned_identity(mesh, 0.1), mesh, mesh);
    const ReliefAgreement relief_agreement(map, 3, relief_pairs(mesh, mesh));
    const double step = 1e-6;
    double largest = 0;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const SurfacePoint image = map.point(v);
        if (image.barycentric.minCoeff() < 0.01) continue;
        const auto frame = map.tangents(v);
        const Eigen::Vector2d gradient = relief_agreement.derivatives(v, frame).gradient;
        largest = std::max(largest, gradient.norm());
        for (int axis = 0; axis < 2; ++axis) {
            map.move(v, step * frame.col(axis));
            const double ahead = relief_agreement.value(v);
            map.place(v, image);
            map.move(v, -step * frame.col(axis));
            const double behind = relief_agreement.value(v);
            map.place(v, image);
            EXPECT_NEAR(gradient[axis], (ahead - behind) / (2 * step), 1e-4 * largest + 1e-9) << v;
        }
    }
    EXPECT_GT(largest, 1e-4);
}

TEST(ReliefAgreement, IsThatOfSurfacesOfUnitArea) {
    const TriangleMesh mesh = bumpy_sphere();
    const PointMap start = shapes::turned_identity(mesh, 0.1);
    const VertexData<bool> pinned(mesh.vertex_count());
    UntanglingOptions options;
    options.global_steps = 2;
    const auto untangled = [&](double unit) {
        TriangleMesh scaled = mesh, longer = mesh;
        scaled.vertices *= unit;
        longer.vertices *= unit;
        longer.vertices.col(2) *= 1.2;  // no map is perfect, so that relief decides where it ends
        MapPair maps{start, start};
        untangle(maps, scaled, longer, {pinned, pinned}, options);
        return maps.A_to_B;
    };
    const PointMap map = untangled(1), other = untangled(.01);
    for (int v = 0; v < mesh.vertex_count(); ++v)
        EXPECT_LT((position(mesh, other[v]) - position(mesh, map[v])).norm(), 1e-6);
}

TEST(ReliefAgreement, TurnsAMapBackToWhereItsReliefIs) {
    const TriangleMesh mesh = bumpy_sphere();
    const PointMap start = shapes::turned_identity(mesh, 0.1);
    UntanglingOptions options;
    options.global_steps = 6;
    // The other direction is turned the same way, so that being inverse to it draws to neither map's truth.
    MapPair with{start, start}, without = with;
    const VertexData<bool> pinned(mesh.vertex_count());
    untangle(with, mesh, mesh, {pinned, pinned}, options);
    options.relief_weight = 0;
    untangle(without, mesh, mesh, {pinned, pinned}, options);
    for (const auto& [found, alone] :
         {std::pair(with.A_to_B, without.A_to_B), std::pair(with.B_to_A, without.B_to_A)}) {
        EXPECT_LT(mean_error(found, mesh), 0.1 * mean_error(start, mesh));
        EXPECT_LT(mean_error(found, mesh), 0.3 * mean_error(alone, mesh));
    }
}

}  // namespace
}  // namespace varimap
