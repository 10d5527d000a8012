#include "varimap/quality/patch_alignment.h"

#include <gtest/gtest.h>

#include "fixtures/shapes.h"
#include "varimap/geodesics/geodesic_graph.h"
#include "varimap/mesh/mass.h"

namespace varimap {
namespace {

struct Patches {
    TriangleMesh mesh = shapes::figure(.2);
    Points normals = vertex_normals(mesh);
    PatchAlignment alignment{mesh.vertices, normals, voronoi_masses(mesh)};

    Patches() {
        const std::vector<int> centres{0, mesh.vertex_count() / 2};
        alignment.add_patches(distances_from_each(GeodesicGraph(mesh), centres), 1.5, Eigen::Vector2d(1, 2));
    }
};

TEST(PatchAlignment, RigidBodiesAlign) {
    const Patches patches;
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.2, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    const Points moved =
        (3 * patches.mesh.vertices * turn.transpose()).rowwise() + Eigen::RowVector3d(5, 6, 7);
    EXPECT_NEAR(patches.alignment(moved, patches.normals * turn.transpose(), false), 1, 1e-9);
}

TEST(PatchAlignment, ReflectionsAlignAsOpposedSurfacesAlone) {
    const Patches patches;
    const Eigen::RowVector3d mirror(-1, 1, 1);
    const Points images = patches.mesh.vertices.array().rowwise() * mirror.array(),
                 normals = patches.normals.array().rowwise() * mirror.array();
    EXPECT_NEAR(patches.alignment(images, normals, true), 1, 1e-9);
    EXPECT_LT(patches.alignment(images, normals, false), .95);
}

TEST(PatchAlignment, OtherPlacesAlignLess) {
    const Patches patches;
    EXPECT_LT(patches.alignment(patches.mesh.vertices.colwise().reverse(),
                                patches.normals.colwise().reverse(), false),
              .9);
}

}  // namespace
}  // namespace varimap
