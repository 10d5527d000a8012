#include "varimap/mesh/thin_faces.h"

#include <gtest/gtest.h>

#include "fixtures/shapes.h"
#include "varimap/mesh/manifold.h"
#include "varimap/mesh/topology.h"

namespace varimap {
namespace {

constexpr double thinnest = 1e-6;

int thin_faces(const TriangleMesh& mesh) {
    int count = 0;
    for (int f = 0; f < mesh.face_count(); ++f) count += thinness(mesh, f) < thinnest;
    return count;
}

/// A sphere on which vertex 40 was moved to its neighbour, up to `distance`.
TriangleMesh with_short_edge(double distance) {
    TriangleMesh mesh = shapes::ellipsoid(2);
    const int other = vertex_neighbours(mesh)[40][0];
    const Vec3 direction = (mesh.vertex(40) - mesh.vertex(other)).normalized();
    mesh.vertices.row(40) = (mesh.vertex(other) + distance * direction).transpose();
    return mesh;
}

TEST(Thinness, IsHeightOverLength) {
    const TriangleMesh mesh =
        shapes::make_mesh({{0, 0, 0}, {4, 0, 0}, {1, .5, 0}, {2, 0, 0}}, {{0, 1, 2}, {0, 1, 3}});
    EXPECT_NEAR(thinness(mesh, 0), .125, 1e-15);
    EXPECT_EQ(thinness(mesh, 1), 0);
}

TEST(RemoveThinFaces, LeavesGoodMeshesAsTheyAre) {
    const TriangleMesh mesh = shapes::figure(.15);
    const ThinFaceRemoval repair = remove_thin_faces(mesh, thinnest);
    EXPECT_EQ(repair.mesh.vertices, mesh.vertices);
    EXPECT_EQ(repair.mesh.faces, mesh.faces);
    EXPECT_EQ(repair.collapsed + repair.turned, 0);
    for (int v = 0; v < mesh.vertex_count(); ++v) EXPECT_EQ(repair.vertex[v], v);
}

TEST(RemoveThinFaces, CollapsesTheShortSideOfNeedles) {
    for (const double distance : {0., 1e-9}) {
        const TriangleMesh mesh = with_short_edge(distance);
        ASSERT_EQ(thin_faces(mesh), 2);
        const ThinFaceRemoval repair = remove_thin_faces(mesh, thinnest);
        EXPECT_EQ(repair.collapsed, 1);
        EXPECT_EQ(thin_faces(repair.mesh), 0);
        EXPECT_NO_THROW(require_manifold(repair.mesh, "repaired"));
        EXPECT_EQ(repair.mesh.vertex_count(), mesh.vertex_count() - 1);
        EXPECT_EQ(repair.mesh.face_count(), mesh.face_count() - 2);
        for (int v = 0; v < mesh.vertex_count(); ++v)
            EXPECT_LE((repair.mesh.vertex(repair.vertex[v]) - mesh.vertex(v)).norm(), 1.1e-9);
        for (int f = 0; f < repair.mesh.face_count(); ++f)
            EXPECT_GT(face_normal(repair.mesh, f).dot(face_normal(mesh, repair.origin[f])), 0);
    }
}

TEST(RemoveThinFaces, TurnsTheLongSideOfCaps) {
    for (const double height : {0., 1e-8, -1e-8}) {
        int cap;
        const TriangleMesh mesh = shapes::with_cap(shapes::ellipsoid(2), height, cap);
        ASSERT_EQ(thin_faces(mesh), 1);
        const ThinFaceRemoval repair = remove_thin_faces(mesh, thinnest);
        EXPECT_EQ(repair.turned, 1);
        EXPECT_EQ(thin_faces(repair.mesh), 0);
        EXPECT_NO_THROW(require_manifold(repair.mesh, "repaired"));
        EXPECT_EQ(repair.mesh.vertices, mesh.vertices);
        EXPECT_NEAR(surface_area(repair.mesh), surface_area(mesh), 1e-7);
        for (int f = 0; f < repair.mesh.face_count(); ++f) {
            EXPECT_NE(repair.origin[f], cap);
            EXPECT_GT(face_normal(repair.mesh, f).dot(face_normal(mesh, repair.origin[f])), 0) << f;
        }
    }
}

TEST(RemoveThinFaces, KeepsWhatItCannotRemove) {
    // A tetrahedron all of whose corners are on one line cannot lose a face.
    const TriangleMesh flat = shapes::make_mesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}},
                                                {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}});
    const ThinFaceRemoval repair = remove_thin_faces(flat, thinnest);
    EXPECT_EQ(repair.mesh.face_count(), 4);
    EXPECT_EQ(thin_faces(repair.mesh), 4);
}

}  // namespace
}  // namespace varimap
