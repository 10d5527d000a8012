#include "varimap/mesh_repair/handles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fixtures/shapes.h"
#include "fixtures/together.h"
#include "varimap/core/error.h"
#include "varimap/mesh/manifold.h"
#include "varimap/mesh/topology.h"

namespace varimap {
namespace {

RepairedMesh cut(const TriangleMesh& mesh, double length) {
    RepairedMesh result = handles_cut({mesh, {}, {}}, length);
    require_sheets(result.mesh, "cut");
    return result;
}

/// A ring whose tube is thick about as far as its tunnel is wide: 2 pi * .35 against 2 pi * .65 around.
TriangleMesh ring() {
    return shapes::torus(1, 0.35, 60, 24);
}
/// The paths around its tube, in units of sqrt(area).
double around_tube() {
    return 2 * M_PI * 0.35 / std::sqrt(surface_area(ring()));
}

TEST(Handles, AreCutThroughAndBothRimsClosed) {
    const TriangleMesh mesh = ring();
    const RepairedMesh result = cut(mesh, 1.05 * around_tube());
    EXPECT_EQ(result.counts.cut_handles, 1);
    EXPECT_TRUE(is_closed(result.mesh));
    EXPECT_EQ(summarise_topology(result.mesh).genus, 0);
    // The cut is one section of the tube: a vertex of each of its 24 rows is there twice.
    EXPECT_EQ(result.mesh.vertex_count(), mesh.vertex_count() + 24);
    EXPECT_NEAR(signed_volume(result.mesh), signed_volume(mesh), 1e-9);
    EXPECT_NEAR(surface_area(result.mesh), surface_area(mesh) + 2 * M_PI * .35 * .35, .02);
}

TEST(Handles, LongerOnesStay) {
    const RepairedMesh result = cut(ring(), 0.95 * around_tube());
    EXPECT_EQ(result.counts.cut_handles, 0);
    EXPECT_TRUE(result.link.is_identity());
    EXPECT_EQ(result.mesh.faces, ring().faces);
}

TEST(Handles, ManyAreTakenForNoise) {
    TriangleMesh rings = ring();
    const auto add = [&](int count) {
        for (int i = 0; i < count; ++i) rings = shapes::together(rings, ring());
    };
    add(19);
    EXPECT_EQ(longest_handle("auto", rings), 0);
    add(1);
    EXPECT_EQ(longest_handle("auto", rings), 0.05);
    EXPECT_EQ(longest_handle("none", rings), 0);
    EXPECT_EQ(longest_handle(".1", rings), .1);
    for (const char* words : {"", "some", "-1", "2", "nan", ".1 ", "inf"})
        EXPECT_THROW(longest_handle(words, rings), UsageError) << words;
}

/// The way back: rows of the file keep their meaning, faces that close a rim are added ones.
TEST(Handles, KeepTheWayBackToTheFile) {
    const TriangleMesh mesh = ring();
    const RepairedMesh result = cut(mesh, 1.05 * around_tube());
    const FileLink& link = result.link;
    ASSERT_EQ(int(link.origin.size()), result.mesh.vertex_count());
    for (int v = 0; v < result.mesh.vertex_count(); ++v)
        EXPECT_EQ(result.mesh.vertex(v), mesh.vertex(link.origin[std::size_t(v)]));
    ASSERT_EQ(int(link.face.size()), result.mesh.face_count());
    for (int f = 0; f < result.mesh.face_count(); ++f) {
        EXPECT_EQ(link.face[std::size_t(f)], f < mesh.face_count() ? f : -1);
        if (f >= mesh.face_count()) continue;
        for (int c = 0; c < 3; ++c)
            EXPECT_EQ(link.origin[std::size_t(result.mesh.faces(f, c))], mesh.faces(f, c));
    }
    EXPECT_EQ(std::count(link.fate.begin(), link.fate.end(), VertexFate::split), 24);
    EXPECT_EQ(std::count(link.fate.begin(), link.fate.end(), VertexFate::kept), mesh.vertex_count() - 24);
}

/// Paths that separate the surface are none, however short: around a limb or a waist.
TEST(Handles, LimbsStayOn) {
    const RepairedMesh limbs = cut(shapes::figure(0.15), 0.5);
    EXPECT_EQ(limbs.counts.cut_handles, 0);
    EXPECT_TRUE(limbs.link.is_identity());
    EXPECT_EQ(cut(shapes::tube(30, 12, false), 10).counts.cut_handles, 0);  // open ends stay, too
}

/// Each component for itself; the shortest first, whatever the limit.
TEST(Handles, AreCutOnEveryComponent) {
    const TriangleMesh two = shapes::together(ring(), shapes::torus(4, 0.2, 150, 12));
    const double thin = 2 * M_PI * 0.2 / std::sqrt(surface_area(two));
    EXPECT_EQ(cut(two, 1.05 * thin).counts.cut_handles, 1);
    const RepairedMesh both = cut(two, 1.8 * thin);
    EXPECT_EQ(both.counts.cut_handles, 2);
    EXPECT_TRUE(is_closed(both.mesh));
    EXPECT_EQ(both.mesh.vertex_count(), two.vertex_count() + 24 + 12);
    EXPECT_EQ(connected_components(both.mesh).count, 2);
}

/// Where a mesh lies, and how large it is, changes nothing.
TEST(Handles, AreTheSameOnAMovedCopy) {
    TriangleMesh mesh = ring();
    for (int v = 0; v < mesh.vertex_count(); ++v)  // of the even ring many paths and sections are alike
        mesh.vertices.row(v) +=
            .02 * Vec3(std::sin(v * v), std::sin(v * v + 1), std::sin(v * v + 2)).transpose();
    const Faces faces = cut(mesh, 1.05 * around_tube()).mesh.faces;
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(.3, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    mesh.vertices = 7.3 * (mesh.vertices * turn.transpose());
    mesh.vertices.rowwise() += Vec3(5, -3, 2).transpose();
    EXPECT_EQ(cut(mesh, 1.05 * around_tube()).mesh.faces, faces);
}

}  // namespace
}  // namespace varimap
