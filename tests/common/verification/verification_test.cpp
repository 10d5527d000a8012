#include "varimap/verification/verification.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"
#include "stages/generate/level_set.h"
#include "varimap/mesh/closest_point.h"
#include "varimap/mesh/topology.h"
#include "varimap/verification/map_degree.h"

namespace varimap {
namespace {

using shapes::at_vertices;
using shapes::map_by;
using std::numbers::pi;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// p turned about the z axis until its longitude is `factor` times as large.
Vec3 wind(const Vec3& p, double factor) {
    const double longitude = factor * std::atan2(p[1], p[0]), radius = std::hypot(p[0], p[1]);
    return {radius * std::cos(longitude), radius * std::sin(longitude), p[2]};
}

TriangleMesh inside_out(TriangleMesh mesh) {
    mesh.faces.col(1).swap(mesh.faces.col(2));
    return mesh;
}

/// Rings around vertex 0 in the origin, up to radius 1 and angle `angle` (2 pi: closed up), with
/// height(radius, angle).
template <class Height>
TriangleMesh fan(int rings, int sectors, double angle, const Height& height) {
    const bool is_whole = angle > 2 * pi - 1e-9;
    const int columns = is_whole ? sectors : sectors + 1;
    std::vector<Vec3> points{Vec3(0, 0, height(0., 0.))};
    std::vector<std::array<int, 3>> faces;
    for (int r = 1; r <= rings; ++r)
        for (int s = 0; s < columns; ++s) {
            const double radius = double(r) / rings, at = s * angle / sectors;
            points.push_back(Vec3(radius * std::cos(at), radius * std::sin(at), height(radius, at)));
        }
    const auto vertex = [&](int r, int s) { return r == 0 ? 0 : 1 + (r - 1) * columns + s % columns; };
    for (int r = 0; r < rings; ++r)
        for (int s = 0; s < sectors; ++s) {
            faces.push_back({vertex(r, s), vertex(r + 1, s), vertex(r + 1, s + 1)});
            if (r > 0) faces.push_back({vertex(r, s), vertex(r + 1, s + 1), vertex(r, s + 1)});
        }
    return shapes::make_mesh(points, faces);
}

TriangleMesh flat_fan(int rings, int sectors, double angle) {
    return fan(rings, sectors, angle, [](double, double) { return 0.; });
}

void expect_faultless(const Verification& found, double tolerance = 1e-9) {
    EXPECT_THAT(found.reversed_faces, IsEmpty());
    EXPECT_EQ(found.reversed_area_percent, 0);
    EXPECT_THAT(found.branch_vertices, IsEmpty());
    EXPECT_NEAR(found.signed_area_ratio, 1, tolerance);
    EXPECT_EQ(found.left_out_count, 0);
}

TEST(Verification, IdentityIsFaultless) {
    for (const TriangleMesh& mesh :
         {shapes::ellipsoid(3), shapes::ellipsoid(0), shapes::torus(2, 0.7, 40, 16), shapes::figure(0.15)}) {
        const Verification found = verify_map(at_vertices(mesh), mesh, mesh);
        expect_faultless(found);
        EXPECT_EQ(found.degree.value(), 1);
    }
}

TEST(Verification, VerticesThatLineUpWithTheAxesDoNotHideTheDegree) {
    // Both have vertices on the same planes of a grid, through which rays from inside pass.
    const auto cube = [](const Vec3& p) {
        return std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])}) - 1;
    };
    const TriangleMesh box = shapes::level_set(cube, Vec3::Constant(-1.5), Vec3::Constant(1.5), 0.25);
    const TriangleMesh image = shapes::shuffled(box, 3);
    const auto stay = [](const Vec3& p) { return p; };
    EXPECT_EQ(verify_map(map_by(image, box, stay), image, box).degree.value(), 1);
}

TEST(Verification, OpenSurfacesHaveNoDegree) {
    for (const TriangleMesh& mesh : {shapes::square(8), shapes::tube(20, 12, false)}) {
        const Verification found = verify_map(at_vertices(mesh), mesh, mesh);
        expect_faultless(found);
        EXPECT_FALSE(found.degree.has_value());
    }
}

TEST(Verification, MapsBetweenUnequalMeshesAreFaultless) {
    const auto stay = [](const Vec3& p) { return p; };
    const TriangleMesh coarse = shapes::ellipsoid(3, Vec3(1, 2, 0.6)),
                       fine = shapes::ellipsoid(4, Vec3(1, 2, 0.6));
    const Verification down = verify_map(map_by(fine, coarse, stay), fine, coarse);
    expect_faultless(down, 0.01);
    EXPECT_EQ(down.degree.value(), 1);
    const Verification up = verify_map(map_by(coarse, fine, stay), coarse, fine);
    expect_faultless(up, 0.02);
    EXPECT_EQ(up.degree.value(), 1);
}

TEST(Verification, DoesNotDependOnScalePlaceAndSide) {
    const TriangleMesh mesh = shapes::figure(0.15),
                       moved = shapes::moved(mesh, 1e3, 0.7, Vec3(1e4, -2e4, 3e3));
    const Verification found = verify_map(at_vertices(mesh), mesh, moved);
    expect_faultless(found);
    EXPECT_EQ(found.degree.value(), 1);
    const TriangleMesh turned = inside_out(mesh);
    const Verification outwards_in = verify_map(at_vertices(turned), turned, turned);
    expect_faultless(outwards_in);
    EXPECT_EQ(outwards_in.degree.value(), 1);
}

TEST(Verification, MirrorImageIsAllReversed) {
    const TriangleMesh mesh = shapes::ellipsoid(3, Vec3(1, 2, 0.6));
    const PointMap mirror = map_by(mesh, mesh, [](const Vec3& p) { return Vec3(-p[0], p[1], p[2]); });
    const Verification found = verify_map(mirror, mesh, mesh);
    EXPECT_EQ(int(found.reversed_faces.size()), mesh.face_count());
    EXPECT_NEAR(found.reversed_area_percent, 100, 1e-9);
    EXPECT_THAT(found.branch_vertices, IsEmpty());
    EXPECT_NEAR(found.signed_area_ratio, -1, 1e-9);
    EXPECT_EQ(found.degree.value(), -1);
}

TEST(Verification, DoubleCoverHasDegreeTwo) {
    const TriangleMesh source = shapes::torus(2, 0.7, 80, 16), target = shapes::torus(2, 0.7, 40, 16);
    const PointMap cover = map_by(source, target, [](const Vec3& p) { return wind(p, 2); });
    const Verification found = verify_map(cover, source, target);
    EXPECT_THAT(found.reversed_faces, IsEmpty());
    EXPECT_THAT(found.branch_vertices, IsEmpty()) << "a cover without branch points";
    EXPECT_NEAR(found.signed_area_ratio, 2, 1e-6);
    EXPECT_EQ(found.degree.value(), 2);
}

TEST(Verification, FindsTheBranchPointsOfASquare) {
    TriangleMesh mesh = shapes::ellipsoid(4);
    const Vec3 pole = mesh.vertex(3);  // of the icosahedron: the opposite vertex is number 0
    const auto to_axis = Eigen::Quaterniond::FromTwoVectors(pole, Vec3::UnitZ());
    mesh.vertices = mesh.vertices * to_axis.toRotationMatrix().transpose();
    const PointMap square = map_by(mesh, mesh, [](const Vec3& p) { return wind(p, 2); });
    const Verification found = verify_map(square, mesh, mesh);
    EXPECT_THAT(found.reversed_faces, IsEmpty());
    EXPECT_THAT(found.branch_vertices, ElementsAre(0, 3));
    EXPECT_NEAR(found.signed_area_ratio, 2, 0.05);
    EXPECT_EQ(found.degree.value(), 2);
    const PointMap conjugate = map_by(mesh, mesh, [](const Vec3& p) { return wind(p, -2); });
    const Verification backwards = verify_map(conjugate, mesh, mesh);
    EXPECT_NEAR(backwards.reversed_area_percent, 100, 1e-9);
    EXPECT_THAT(backwards.branch_vertices, ElementsAre(0, 3));
    EXPECT_EQ(backwards.degree.value(), -2);
}

TEST(Verification, FindsABranchPointOfADisc) {
    const TriangleMesh disc = flat_fan(10, 30, 2 * pi);
    const TriangleMesh target = shapes::moved(flat_fan(7, 24, 2 * pi), 1.2, 0, Vec3(0.01, 0.02, 0));
    const Verification once = verify_map(map_by(disc, target, [](const Vec3& p) { return p; }), disc, target);
    EXPECT_THAT(once.branch_vertices, IsEmpty());
    const PointMap square = map_by(disc, target, [](const Vec3& p) { return wind(p, 2); });
    const Verification twice = verify_map(square, disc, target);
    EXPECT_THAT(twice.reversed_faces, IsEmpty());
    EXPECT_THAT(twice.branch_vertices, ElementsAre(0));
    EXPECT_NEAR(twice.signed_area_ratio, 2 / 1.44, 0.05);
}

TEST(Verification, BoundaryVerticesBranchOnlyWhereTheyOverlapThemselves) {
    const TriangleMesh half = flat_fan(6, 24, pi), target = flat_fan(6, 31, 2 * pi);
    const auto branches = [&](double factor) {
        const PointMap map = map_by(half, target, [&](const Vec3& p) { return Vec3(0.9 * wind(p, factor)); });
        return verify_map(map, half, target).branch_vertices;
    };
    EXPECT_THAT(branches(1), IsEmpty());
    EXPECT_THAT(branches(1.9), IsEmpty()) << "a corner opened to almost a full turn";
    EXPECT_THAT(branches(4), ElementsAre(0));
}

TEST(Verification, SaddlesAreNoBranchPoints) {
    const TriangleMesh saddle =
        fan(4, 24, 2 * pi, [](double r, double a) { return 3 * r * std::cos(2 * a); });
    expect_faultless(verify_map(at_vertices(saddle), saddle, saddle));
    PointMap beside = at_vertices(saddle);
    beside[0].barycentric = Vec3(0.9, 0.06, 0.04);
    EXPECT_THAT(verify_map(beside, saddle, saddle).branch_vertices, IsEmpty());
}

TEST(Verification, FindsBranchPointsAtTips) {
    const auto steep = [](double r, double) { return -1.5 * r; };
    const TriangleMesh source = fan(6, 48, 2 * pi, steep), tip = fan(6, 24, 2 * pi, steep);
    const Verification found =
        verify_map(map_by(source, tip, [](const Vec3& p) { return wind(p, 2); }), source, tip);
    EXPECT_THAT(found.reversed_faces, IsEmpty());
    EXPECT_THAT(found.branch_vertices, ElementsAre(0));
}

TEST(Verification, FoldedRingIsReversed) {
    const TriangleMesh mesh = shapes::ellipsoid(5);
    const auto fold = [](const Vec3& p) {
        const double from_pole = std::acos(p[2]);
        const double to = from_pole < 0.7   ? 1.2 * std::min(from_pole, 0.5) - std::max(0., from_pole - 0.5)
                          : from_pole < 1.4 ? 0.4 + (from_pole - 0.7) / 0.7
                                            : from_pole;
        const double ring = std::sin(to) / std::max(std::sin(from_pole), 1e-9);
        return Vec3(ring * p[0], ring * p[1], std::cos(to));
    };
    const Verification found = verify_map(map_by(mesh, mesh, fold), mesh, mesh);
    EXPECT_NEAR(found.reversed_area_percent, 50 * (std::cos(0.5) - std::cos(0.7)), 0.8);
    EXPECT_THAT(found.branch_vertices, IsEmpty());
    EXPECT_NEAR(found.signed_area_ratio, 1, 0.01) << "what lies twice is taken away by what is reversed";
    EXPECT_EQ(found.degree.value(), 1);
}

TEST(Verification, SingleFlipIsFound) {
    const TriangleMesh mesh = shapes::square(6);
    PointMap map = at_vertices(mesh);
    const int f = 30;
    map[std::size_t(mesh.faces(f, 0))] = {f, Vec3(-0.3, 0.65, 0.65)};  // past the opposite side
    const Verification found = verify_map(map, mesh, mesh);
    EXPECT_THAT(found.reversed_faces, ElementsAre(f));
    EXPECT_NEAR(found.reversed_area_percent, 100. / mesh.face_count(), 1e-9);
    EXPECT_NEAR(found.signed_area_ratio, 1, 1e-9);
    EXPECT_THAT(found.branch_vertices, IsEmpty());
}

TEST(Verification, CollapsedTrianglesAreReversed) {
    const TriangleMesh mesh = shapes::ellipsoid(2);
    const PointMap point(std::size_t(mesh.vertex_count()), SurfacePoint{5, Vec3(0.2, 0.3, 0.5)});
    const Verification found = verify_map(point, mesh, mesh);
    EXPECT_EQ(int(found.reversed_faces.size()), mesh.face_count());
    EXPECT_THAT(found.branch_vertices, IsEmpty());
    EXPECT_NEAR(found.signed_area_ratio, 0, 1e-12);
    EXPECT_EQ(found.degree.value(), 0);
}

TEST(Verification, VerticesWithoutImageAreLeftOut) {
    const TriangleMesh mesh = shapes::ellipsoid(2);
    PointMap map = at_vertices(mesh);
    map[0] = {};
    const Verification found = verify_map(map, mesh, mesh);
    EXPECT_THAT(found.reversed_faces, IsEmpty());
    EXPECT_EQ(found.left_out_count, 5) << "an icosahedron's vertex has five faces";
    EXPECT_FALSE(found.degree.has_value());
}

TEST(Verification, SourceTrianglesWithoutAreaAreNotJudged) {
    TriangleMesh needle = shapes::square(4);
    const PointMap map = at_vertices(needle);
    const TriangleMesh target = needle;
    needle.vertices.row(needle.faces(9, 1)) = needle.vertices.row(needle.faces(9, 0));
    EXPECT_THAT(verify_map(map, needle, target).reversed_faces, IsEmpty());
}

TEST(MapDegree, LosesTheAreaOfAMissedLimb) {
    TriangleMesh mesh = shapes::ellipsoid(5);
    for (int v = 0; v < mesh.vertex_count(); ++v)
        if (mesh.vertices(v, 2) > 0.9) mesh.vertices(v, 2) = 0.9 + 20 * (mesh.vertices(v, 2) - 0.9);
    double limb = 0;
    for (int f = 0; f < mesh.face_count(); ++f)
        if (position(mesh, {f, Vec3::Constant(1. / 3)})[2] > 0.9) limb += face_normal(mesh, f).norm() / 2;
    const double share = limb / surface_area(mesh);
    ASSERT_GT(share, 0.1);
    TriangleMesh image = mesh;
    for (int v = 0; v < mesh.vertex_count(); ++v) image.vertices(v, 2) = std::min(image.vertices(v, 2), 0.9);
    EXPECT_NEAR(map_degree(image, mesh).value(), 1 - share, 0.03);
}

TEST(MapDegree, KnowsClosedSurfaces) {
    EXPECT_TRUE(is_closed(shapes::torus(2, 0.5, 12, 8)));
    EXPECT_FALSE(is_closed(shapes::square(3)));
    TriangleMesh turned = shapes::ellipsoid(0);
    std::swap(turned.faces(4, 0), turned.faces(4, 1));
    EXPECT_FALSE(is_closed(turned)) << "one face looks the other way";
}

}  // namespace
}  // namespace varimap
