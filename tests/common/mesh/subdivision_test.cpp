#include "varimap/mesh/subdivision.h"

#include <gtest/gtest.h>

#include "fixtures/shapes.h"
#include "varimap/mesh/topology.h"

namespace varimap {
namespace {

TEST(Subdivision, KeepsTheSurface) {
    const TriangleMesh mesh = shapes::ellipsoid(1, {1, 1.2, 1.6});
    const Subdivision finer = subdivide(mesh);
    EXPECT_EQ(finer.mesh.face_count(), 4 * mesh.face_count());
    EXPECT_NEAR(surface_area(finer.mesh), surface_area(mesh), 1e-12);
    EXPECT_NEAR(signed_volume(finer.mesh), signed_volume(mesh), 1e-12);
    EXPECT_TRUE(is_closed(finer.mesh));
    EXPECT_EQ(finer.mesh.vertices.topRows(mesh.vertex_count()), mesh.vertices);
    for (std::size_t i = 0; i < finer.midpoints.size(); ++i)
        EXPECT_EQ(position(mesh, finer.midpoints[i]), finer.mesh.vertex(mesh.vertex_count() + int(i)));
}

TEST(Subdivision, KnowsWherePointsAre) {
    const TriangleMesh mesh = shapes::square(2);
    const TriangleMesh finer = subdivide(mesh).mesh;
    for (const Vec3& b :
         {Vec3(.7, .1, .2), Vec3(.1, .8, .1), Vec3(.25, .25, .5), Vec3(.3, .3, .4), Vec3(.5, .5, 0)}) {
        const SurfacePoint at = on_subdivision({3, b});
        EXPECT_GE(at.barycentric.minCoeff(), 0);
        EXPECT_LT((position(finer, at) - position(mesh, {3, b})).norm(), 1e-15);
    }
    for (int k = 0; k < 3; ++k)
        EXPECT_EQ(vertex_of(finer, on_subdivision({3, Vec3::Unit(k)})), mesh.faces(3, k)) << "exactly";
    EXPECT_EQ(on_subdivision({}).face, -1);
}

}  // namespace
}  // namespace varimap
