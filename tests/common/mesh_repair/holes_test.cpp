#include "varimap/mesh_repair/holes.h"

#include <gtest/gtest.h>

#include <limits>

#include "fixtures/shapes.h"
#include "fixtures/together.h"
#include "varimap/core/error.h"
#include "varimap/mesh/manifold.h"
#include "varimap/mesh/topology.h"

namespace varimap {
namespace {

constexpr int all = std::numeric_limits<int>::max();

/// The mesh without the faces around some vertices, which no face uses then.
TriangleMesh pierced(const TriangleMesh& mesh, const std::vector<int>& vertices) {
    std::vector<int> left;
    for (int f = 0; f < mesh.face_count(); ++f) {
        bool is_left = true;
        for (const int v : mesh.faces.row(f))
            is_left = is_left && std::find(vertices.begin(), vertices.end(), v) == vertices.end();
        if (is_left) left.push_back(f);
    }
    return {mesh.vertices, mesh.faces(left, Eigen::all)};
}

RepairedMesh filled(const TriangleMesh& mesh, int edges) {
    RepairedMesh result = holes_filled({mesh, {}, {}}, edges);
    require_manifold(result.mesh, "filled");
    return result;
}

TEST(Holes, CloseWithTheLeastAreaAndKeepWhatIsThere) {
    const TriangleMesh whole = shapes::ellipsoid(3);
    const TriangleMesh mesh = pierced(whole, {20, 200});
    ASSERT_EQ(summarise_topology(mesh).boundary_loops, 2);
    const RepairedMesh result = filled(mesh, all);
    EXPECT_TRUE(is_closed(result.mesh));
    EXPECT_EQ(result.counts.filled_holes, 2);
    EXPECT_EQ(result.counts.unfilled_holes, 0);
    EXPECT_EQ(result.mesh.face_count(), mesh.face_count() + result.counts.filling_faces);
    EXPECT_EQ(result.mesh.vertices, mesh.vertices);
    EXPECT_EQ(result.mesh.faces.topRows(mesh.face_count()), mesh.faces);
    EXPECT_NEAR(surface_area(result.mesh), surface_area(whole), .02 * surface_area(whole));
    EXPECT_GT(signed_volume(result.mesh), .97 * signed_volume(whole));
    for (int f = 0; f < result.mesh.face_count(); ++f)
        EXPECT_EQ(result.link.face[std::size_t(f)], f < mesh.face_count() ? f : -1);
    EXPECT_EQ(result.link.fate[20], VertexFate::unused);
    EXPECT_EQ(result.link.fate[0], VertexFate::kept);
}

/// The faces marked have a vertex more, in the middle of their first edge, which the faces beside them lack.
TriangleMesh with_t_junctions(const TriangleMesh& mesh, const std::vector<int>& marked) {
    TriangleMesh result = mesh;
    for (const int f : marked) {
        const int a = mesh.faces(f, 0), b = mesh.faces(f, 1), c = mesh.faces(f, 2);
        const int middle = result.vertex_count(), half = result.face_count();
        result.vertices.conservativeResize(middle + 1, 3);
        result.vertices.row(middle) = (mesh.vertices.row(a) + mesh.vertices.row(b)) / 2;
        result.faces.conservativeResize(half + 1, 3);
        result.faces.row(f) << a, middle, c;
        result.faces.row(half) << middle, b, c;
    }
    return result;
}

/// One by one, and where slits run into each other.
TEST(Holes, SlitsOfTJunctionsAreClosed) {
    const TriangleMesh whole = shapes::ellipsoid(3);
    std::vector<int> all_faces;
    for (int f = 0; f < whole.face_count(); ++f) all_faces.push_back(f);
    for (const auto& marked : {std::vector{0, 300, 600}, std::vector{0, 1, 2, 3, 40, 41}}) {
        const TriangleMesh file = with_t_junctions(whole, marked);
        const RepairedMesh torn = repaired(file, {}, "m.off");
        ASSERT_GT(summarise_topology(torn.mesh).boundary_loops, 0);
        const RepairedMesh closed = slits_closed(torn);
        require_manifold(closed.mesh, "closed");
        EXPECT_TRUE(is_closed(closed.mesh));
        EXPECT_EQ(closed.counts.closed_slits, summarise_topology(torn.mesh).boundary_loops);
        EXPECT_NEAR(surface_area(closed.mesh), surface_area(torn.mesh), 1e-12);
        for (int f = 0; f < file.face_count(); ++f) EXPECT_EQ(closed.link.face[std::size_t(f)], f);
    }
}

TEST(Holes, OtherHolesAreNoSlits) {
    const TriangleMesh pierced_ball = pierced(shapes::ellipsoid(3), {20});
    for (const TriangleMesh& mesh : {pierced_ball, shapes::square(3), shapes::tube(5, 6, false)}) {
        const RepairedMesh same = slits_closed({mesh, {}, {}});
        EXPECT_EQ(same.counts.closed_slits, 0);
        EXPECT_EQ(same.mesh.faces, mesh.faces);
        EXPECT_TRUE(same.link.is_identity());
    }
}

TEST(Holes, LongerOnesStayOpen) {
    const TriangleMesh whole = shapes::ellipsoid(3);
    const int valence = int(vertex_neighbours(whole)[200].size());
    const TriangleMesh mesh = pierced(whole, {200});
    EXPECT_EQ(filled(mesh, valence - 1).counts.filled_holes, 0);
    EXPECT_TRUE(filled(mesh, valence - 1).link.is_identity());
    EXPECT_EQ(filled(mesh, valence).counts.filled_holes, 1);
    EXPECT_EQ(filled(whole, all).counts.filled_holes, 0);
}

/// An open tube has a loop at each end, of more edges than are triangulated at once.
TEST(Holes, LongLoopsAreClosedToo) {
    const TriangleMesh mesh = shapes::tube(4, 700, false);
    ASSERT_EQ(summarise_topology(mesh).boundary_loops, 2);
    const RepairedMesh result = filled(mesh, all);
    EXPECT_TRUE(is_closed(result.mesh));
    EXPECT_EQ(result.counts.filled_holes, 2);
    EXPECT_EQ(summarise_topology(result.mesh).genus, 0);
}

/// Ears of a rim that were all compared for each that is cut off would take minutes.
TEST(Holes, RimsOfFineScansAreClosedToo) {
    const RepairedMesh result = filled(shapes::tube(2, 50'000, false), all);
    EXPECT_TRUE(is_closed(result.mesh));
    EXPECT_EQ(result.counts.filled_holes, 2);
}

/// Of a strip of three quads, the diagonals that would close it are edges already: those that are not are
/// taken, and a single triangle is left as it is.
TEST(Holes, NoEdgeIsThereTwice) {
    TriangleMesh square;
    square.vertices = Points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    square.faces = Faces{{0, 1, 2}, {0, 2, 3}};
    const RepairedMesh result = filled(square, all);
    EXPECT_EQ(result.counts.filled_holes, 1);
    EXPECT_EQ(result.mesh.face_count(), 4);
    TriangleMesh triangle = square;
    triangle.faces = Faces{{0, 1, 2}};
    const RepairedMesh alone = holes_filled({triangle, {}, {}}, all);
    EXPECT_EQ(alone.mesh.face_count(), 1);
    EXPECT_EQ(alone.counts.unfilled_holes, 1);
}

TEST(Holes, ReadsHowLongTheyMayBe) {
    EXPECT_EQ(longest_hole("none"), 0);
    EXPECT_EQ(longest_hole("12"), 12);
    EXPECT_EQ(longest_hole("all"), all);
    for (const char* words : {"", "2", "-3", "12x", "most", "1e3", "99999999999"})
        EXPECT_THROW(longest_hole(words), UsageError) << words;
}

}  // namespace
}  // namespace varimap
