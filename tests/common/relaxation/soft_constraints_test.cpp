#include "varimap/relaxation/soft_constraints.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"
#include "varimap/relaxation/global_relaxation.h"
#include "varimap/untangling/untangling.h"

namespace varimap {
namespace {

TEST(SoftConstraint, HasTheDerivativesOfItsValue) {
    const TriangleMesh sphere = shapes::ellipsoid(3);
    SlidingMap map(shapes::turned_identity(sphere, 0.1), sphere, sphere);
    const double step = 1e-6;
    for (int f = 0; f < sphere.face_count(); f += 17) {
        const SoftConstraint constraint{{f, Vec3(0.2, 0.5, 0.3)}, map.target().vertex(f / 3), 2, 0.2};
        VertexData<TangentFrame> frames(sphere.vertex_count());
        for (int v = 0; v < sphere.vertex_count(); ++v) frames[v] = map.tangents(v);
        const FaceDerivatives system = derivatives(constraint, map, frames);
        for (int k = 0; k < 3; ++k) {
            const int v = sphere.faces(f, k);
            const SurfacePoint image = map.point(v);
            if (image.barycentric.minCoeff() < 0.01) continue;
            for (int axis = 0; axis < 2; ++axis) {
                map.move(v, step * frames[v].col(axis));
                const double ahead = value(constraint, map);
                map.place(v, image);
                map.move(v, -step * frames[v].col(axis));
                const double behind = value(constraint, map);
                map.place(v, image);
                EXPECT_NEAR(system.gradient[2 * k + axis], (ahead - behind) / (2 * step), 1e-6) << f;
            }
        }
    }
}

TEST(SoftConstraint, DrawsAPointWithinAFaceToItsPlace) {
    const TriangleMesh sphere = shapes::ellipsoid(3);
    SlidingMap map(shapes::turned_identity(sphere, 0), sphere, sphere);
    const VertexData<bool> fixed(sphere.vertex_count());
    GlobalRelaxation relaxation(map, fixed);
    const SurfacePoint from{10, Vec3(0.2, 0.5, 0.3)};
    const Vec3 to = position(map.target(), {11, Vec3(0.3, 0.3, 0.4)});
    const std::vector<SoftConstraint> constraints{{from, to, 1e4, 1}};
    relaxation.set_constraints(constraints);
    const double before = value(constraints[0], map);
    for (int step = 0; step < 10; ++step) relaxation.step({{1, 0.1}, 0});
    // The image triangle passes below the curved surface, so a distance in the normal direction remains.
    EXPECT_LT(value(constraints[0], map), 1e-3 * before);
}

/// Mean distance of every vertex from where it arrives by both maps, there and back.
double round_trip(const MapPair& maps, const TriangleMesh& mesh) {
    double sum = 0;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const SurfacePoint& there = maps.A_to_B[v];
        Vec3 back = Vec3::Zero();
        for (int k = 0; k < 3; ++k)
            back += there.barycentric[k] * position(mesh, maps.B_to_A[mesh.faces(there.face, k)]);
        sum += (back - mesh.vertex(v)).norm();
    }
    return sum / mesh.vertex_count();
}

TEST(InverseConstraints, MakeTwoMapsInverseToEachOther) {
    const TriangleMesh sphere = shapes::ellipsoid(3);
    const MapPair start{shapes::turned_identity(sphere, 0.1), shapes::turned_identity(sphere, 0.1)};
    const VertexData<bool> pinned(sphere.vertex_count());
    UntanglingOptions options;
    options.relief_weight = 0;
    options.replace_parts = false;
    MapPair with = start, without = start;
    untangle(with, sphere, sphere, {pinned, pinned}, options);
    options.inverse_weight = 0;
    untangle(without, sphere, sphere, {pinned, pinned}, options);
    EXPECT_LT(round_trip(with, sphere), 0.1 * round_trip(start, sphere));
    EXPECT_GT(round_trip(without, sphere), 0.5 * round_trip(start, sphere));
}

}  // namespace
}  // namespace varimap
