#include "varimap/mesh/disc.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <set>

#include "fixtures/shapes.h"

namespace varimap {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<int> faces_where(const TriangleMesh& mesh, const std::function<bool(const Vec3&)>& inside) {
    std::vector<int> faces;
    for (int f = 0; f < mesh.face_count(); ++f)
        if (inside((mesh.vertex(mesh.faces(f, 0)) + mesh.vertex(mesh.faces(f, 1)) +
                    mesh.vertex(mesh.faces(f, 2))) /
                   3))
            faces.push_back(f);
    return faces;
}

double signed_area(const TriangleMesh& flat, int f) {
    const Vec3 p = flat.vertex(flat.faces(f, 0));
    return (flat.vertex(flat.faces(f, 1)) - p).cross(flat.vertex(flat.faces(f, 2)) - p).z() / 2;
}

TEST(SubMesh, HasThePointsOfTheWhole) {
    const TriangleMesh whole = shapes::ellipsoid(2);
    const SubMesh part(whole, {3, 20, 21, 100});
    ASSERT_EQ(part.mesh.face_count(), 4);
    const SurfacePoint point{21, {0.2, 0.3, 0.5}};
    const SurfacePoint on_part = part.on_part(point);
    EXPECT_EQ(on_part.face, 2);
    EXPECT_LT((position(part.mesh, on_part) - position(whole, point)).norm(), 1e-15);
    EXPECT_EQ(part.on_whole(on_part).face, 21);
    EXPECT_EQ(part.on_part({22, {1, 0, 0}}).face, -1);
}

TEST(DiscBoundary, GoesOnceAroundADisc) {
    const TriangleMesh square = shapes::square(5);
    const std::vector<int> loop = disc_boundary(square);
    EXPECT_EQ(loop.size(), 20u);
    EXPECT_EQ(std::set<int>(loop.begin(), loop.end()).size(), 20u);
    double area = 0;  // counter-clockwise: the faces are to the left
    for (std::size_t i = 0; i < loop.size(); ++i)
        area += square.vertex(loop[i]).cross(square.vertex(loop[(i + 1) % loop.size()])).z() / 2;
    EXPECT_NEAR(area, 1, 1e-12);
}

TEST(DiscBoundary, IsEmptyForWhatIsNoDisc) {
    EXPECT_THAT(disc_boundary(shapes::ellipsoid(1)), IsEmpty()) << "closed";
    EXPECT_THAT(disc_boundary(shapes::tube(10, 8, false)), IsEmpty()) << "two boundaries";
    const TriangleMesh torus = shapes::torus(2, 0.7, 20, 10);
    std::vector<int> all_but_one(std::size_t(torus.face_count() - 1));
    std::iota(all_but_one.begin(), all_but_one.end(), 1);
    EXPECT_THAT(disc_boundary(SubMesh(torus, all_but_one).mesh), IsEmpty()) << "one boundary, but a handle";
    const TriangleMesh square = shapes::square(2);
    const auto corner_to_corner =
        faces_where(square, [](const Vec3& p) { return (p.x() < 0.5) == (p.y() < 0.5); });
    EXPECT_THAT(disc_boundary(SubMesh(square, corner_to_corner).mesh), IsEmpty()) << "touches itself";
}

TEST(EvenEmbedding, IsPositiveOnTheCircle) {
    const TriangleMesh whole = shapes::ellipsoid(4, {1, 2, 0.2});
    const SubMesh cap(whole, faces_where(whole, [](const Vec3& p) { return p.y() > 0.4; }));
    const TriangleMesh chart = circular_chart(cap.mesh, disc_boundary(cap.mesh));
    for (int f = 0; f < chart.face_count(); ++f) EXPECT_GT(signed_area(chart, f), 0);
    for (const int v : disc_boundary(cap.mesh)) EXPECT_NEAR(chart.vertex(v).norm(), 1, 1e-12);
}

TEST(EvenEmbedding, KeepsAPlaneDisc) {
    // Mean-value coordinates have linear precision; made symmetric, on a grid of equal squares.
    const TriangleMesh square = shapes::square(6);
    const std::vector<int> boundary = disc_boundary(square);
    const Points rim = square.vertices(boundary, Eigen::all);
    const Points embedded = even_embedding(square, boundary, rim);
    EXPECT_LT((embedded - square.vertices).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(EvenEmbedding, LeavesRoomForTheEndOfALimb) {
    const TriangleMesh whole = shapes::tube(60, 16, true);
    const SubMesh limb(whole, faces_where(whole, [](const Vec3& p) { return p.x() > 0.5; }));
    const TriangleMesh chart = circular_chart(limb.mesh, disc_boundary(limb.mesh));
    double tip = 0, all = 0;
    for (int f = 0; f < chart.face_count(); ++f) {
        const double area = signed_area(chart, f);
        EXPECT_GT(area, 0);
        all += area;
        if (limb.mesh.vertex(limb.mesh.faces(f, 0)).x() > 3.5) tip += area;
    }
    // As the mean-value weights alone have it: 4e-11.
    EXPECT_GT(tip / all, 1e-4);
}

TEST(EvenEmbedding, LeavesRoomForTheEndOfAVeryLongLimb) {
    TriangleMesh whole = shapes::tube(200, 16, true);
    whole.vertices.col(0) *= 6;
    const SubMesh limb(whole, faces_where(whole, [](const Vec3& p) { return p.x() > 0.5; }));
    const TriangleMesh chart = circular_chart(limb.mesh, disc_boundary(limb.mesh));
    double least = 1;
    for (int f = 0; f < chart.face_count(); ++f) least = std::min(least, signed_area(chart, f));
    EXPECT_GT(least, 1e-18) << "two rounds leave 7e-35";
}

TEST(FaceSets, FillHolesUpToASize) {
    const TriangleMesh square = shapes::square(10);
    FaceSets sets(square, find_shared_edges(square));
    const auto ring = faces_where(square, [](const Vec3& p) {
        const double r = std::max(std::abs(p.x() - 0.5), std::abs(p.y() - 0.5));
        return r > 0.2 && r < 0.3;
    });
    const auto whole = faces_where(
        square, [](const Vec3& p) { return std::max(std::abs(p.x() - 0.5), std::abs(p.y() - 0.5)) < 0.3; });
    EXPECT_EQ(sets.filled(ring, 32), whole);
    EXPECT_EQ(sets.filled(ring, 31), ring) << "the hole has 32 faces";
    const int inside =
        faces_where(square, [](const Vec3& p) { return (p - Vec3(0.5, 0.5, 0)).norm() < 0.1; })[0];
    EXPECT_EQ(sets.enclosed(ring, {inside}, 40), whole);
    EXPECT_EQ(sets.enclosed(ring, {0}, 40), ring) << "what lies outside is larger";
    EXPECT_EQ(sets.filled(ring, 32), whole) << "nothing is left of earlier questions";
}

TEST(FaceSets, WidenByFacesThatShareAVertex) {
    const TriangleMesh square = shapes::square(9);
    const int middle =
        faces_where(square, [](const Vec3& p) { return (p - Vec3(0.5, 0.5, 0)).norm() < 0.03; })[0];
    FaceSets sets(square, find_shared_edges(square));
    EXPECT_THAT(sets.widened({middle}, 0), ElementsAre(middle));
    EXPECT_EQ(sets.widened({middle}, 1).size(), 13u);
}

}  // namespace
}  // namespace varimap
