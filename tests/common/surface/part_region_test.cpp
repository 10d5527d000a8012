#include "varimap/surface/part_region.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "fixtures/shapes.h"
#include "stages/preprocess/preprocess.h"
#include "varimap/core/error.h"
#include "varimap/mesh/topology.h"

namespace varimap {
namespace {

Vec3 middle(const TriangleMesh& mesh, int f) {
    return position(mesh, {f, Vec3::Constant(1.0 / 3)});
}

template <class Inside>
FaceData<char> marked_where(const TriangleMesh& mesh, const Inside& inside) {
    FaceData<char> marked(mesh.face_count());
    for (int f = 0; f < mesh.face_count(); ++f) marked[f] = inside(middle(mesh, f));
    return marked;
}

PartRegion tidied(const TriangleMesh& mesh, FaceData<char> marked) {
    return {mesh.face_count(), tidy_region(mesh, std::move(marked)), true, {}, 0};
}

TriangleMesh faces_of(const TriangleMesh& mesh, const PartRegion& region) {
    return {mesh.vertices, mesh.faces(region.faces, Eigen::all)};
}

TEST(PartRegion, LosesHolesAndPiecesThatAreSmall) {
    const TriangleMesh ball = shapes::ellipsoid(4);
    auto marked =
        marked_where(ball, [](const Vec3& p) { return p.z() > 0 || (p - Vec3(0, 0, -1)).norm() < .2; });
    int highest = 0;
    for (int f = 1; f < ball.face_count(); ++f)
        if (middle(ball, f).z() > middle(ball, highest).z()) highest = f;
    marked[highest] = 0;
    const PartRegion region = tidied(ball, marked);
    const TopologySummary topology = summarise_topology(faces_of(ball, region));
    EXPECT_EQ(topology.boundary_loops, 1);
    EXPECT_EQ(topology.genus, 0);
    for (const int f : region.faces) EXPECT_GT(middle(ball, f).z(), 0);
}

/// A cap that hangs together with the rest by a strip which covers no face's middle.
TEST(PartRegion, KeepsASmallPieceThatAStripJoinsToTheRest) {
    const TriangleMesh ball = shapes::ellipsoid(4);
    const auto is_cap = [](const Vec3& p) { return (p - Vec3(0, 0, -1)).norm() < .2; };
    auto marked = marked_where(ball, [&](const Vec3& p) { return p.z() > 0 || is_cap(p); });
    const auto strip =
        marked_where(ball, [](const Vec3& p) { return p.x() > 0 && p.z() < .1 && std::abs(p.y()) < .1; });
    const auto unmarked = marked;
    join_patches(ball, strip, marked);
    int added = 0;
    for (int f = 0; f < ball.face_count(); ++f) {
        EXPECT_GE(marked[f], unmarked[f]);
        if (marked[f] == unmarked[f]) continue;
        ++added;
        EXPECT_TRUE(strip[f]);
    }
    EXPECT_GT(added, 5);
    EXPECT_LT(added, 60) << "one face wide";
    const PartRegion region = tidied(ball, marked);
    EXPECT_EQ(summarise_topology(faces_of(ball, region)).boundary_loops, 1);
    EXPECT_TRUE(std::any_of(region.faces.begin(), region.faces.end(),
                            [&](int f) { return is_cap(middle(ball, f)); }));
}

TEST(PartRegion, LeavesPiecesThatNothingJoins) {
    const TriangleMesh ball = shapes::ellipsoid(4);
    auto marked = marked_where(ball, [](const Vec3& p) { return std::abs(p.z()) > .9; });
    const auto before = marked;
    join_patches(ball, marked_where(ball, [](const Vec3& p) { return p.z() > .5; }), marked);
    for (int f = 0; f < ball.face_count(); ++f) EXPECT_EQ(marked[f], before[f]);
}

/// Where the part is in small pieces only, the largest of them is kept.
TEST(PartRegion, IsNeverEmpty) {
    const TriangleMesh square = shapes::square(30);
    FaceData<char> marked(square.face_count());
    for (int f = 0; f < square.face_count(); f += 40) marked[f] = 1;
    EXPECT_FALSE(tidy_region(square, marked).empty());
}

/// Two quarters of a square, whose faces meet in its middle alone.
TEST(PartRegion, HasNoPinches) {
    const TriangleMesh square = shapes::square(8);
    const PartRegion region =
        tidied(square, marked_where(square, [](const Vec3& p) { return (p.x() < .5) == (p.y() < .5); }));
    const TriangleMesh part = faces_of(square, region);
    EXPECT_EQ(summarise_topology(part).boundary_loops, 1);
    EXPECT_EQ(connected_components(part).count, 1);
}

TEST(PartRegion, OfAMeshAsItIsKeepsTheWayToTheFile) {
    const TriangleMesh ball = shapes::ellipsoid(3);
    const PartRegion region = tidied(ball, marked_where(ball, [](const Vec3& p) { return p.z() > 0; }));
    const RepairedMesh cut = cropped({ball, {}, {}}, region);
    ASSERT_EQ(cut.mesh.face_count(), int(region.faces.size()));
    EXPECT_EQ(cut.link.face, region.faces);
    for (int v = 0; v < ball.vertex_count(); ++v) {
        const int own = cut.link.vertex[std::size_t(v)];
        EXPECT_EQ(cut.link.fate[std::size_t(v)], own < 0 ? VertexFate::outside_part : VertexFate::kept);
        if (own >= 0) {
            EXPECT_EQ(cut.mesh.vertex(own), ball.vertex(v));
        }
    }
}

TEST(PartRegion, OfARepairedMeshKeepsTheWayToTheFile) {
    const TriangleMesh ball = shapes::ellipsoid(3);
    TriangleMesh soup{Points(3 * ball.face_count(), 3), Faces(ball.face_count(), 3)};
    for (int s = 0; s < 3 * ball.face_count(); ++s) {
        soup.vertices.row(s) = ball.vertices.row(ball.faces(s / 3, s % 3));
        soup.faces(s / 3, s % 3) = s;
    }
    soup.vertices.conservativeResize(soup.vertices.rows() + 1, 3);  // one that no face uses
    soup.vertices.bottomRows(1).setZero();
    const RepairedMesh whole = prepared(soup, {}, "soup");
    const PartRegion region =
        tidied(whole.mesh, marked_where(whole.mesh, [](const Vec3& p) { return p.z() > 0; }));
    const RepairedMesh cut = cropped(whole, region);
    EXPECT_EQ(cut.link.fate.back(), VertexFate::unused);
    for (int f = 0; f < soup.face_count(); ++f)
        for (int c = 0; c < 3; ++c) {
            const auto v = std::size_t(soup.faces(f, c));
            const int own = cut.link.vertex[v];
            EXPECT_EQ(own < 0, cut.link.fate[v] == VertexFate::outside_part);
            if (own >= 0) {
                EXPECT_EQ(cut.mesh.vertex(own), soup.vertex(int(v)));
            }
        }
    const Surface surface = preprocess(cut, {});
    Surface copy;
    EXPECT_NO_THROW(decode(encode(surface), copy));
}

TEST(PartRegion, OfAnotherMeshIsRefused) {
    EXPECT_THROW(cropped({shapes::ellipsoid(2), {}, {}}, {7, {1, 2}, true, {}, 0}), ArtifactError);
    const PointMap off_its_face{{0, Vec3(7, -3, -3)}};
    PartRegion region;
    for (const PartRegion& bad : {PartRegion{3, {}, true, {}, 0}, PartRegion{3, {1, 3}, true, {}, 0},
                                  PartRegion{3, {-1}, true, {}, 0}, PartRegion{3, {2, 1}, true, {}, 0},
                                  PartRegion{3, {1, 1}, true, {}, 0}, PartRegion{3, {1}, true, {}, -1},
                                  PartRegion{3, {1}, true, off_its_face, 0}})
        EXPECT_THROW(decode(encode(bad), region), ArtifactError);
}

}  // namespace
}  // namespace varimap
