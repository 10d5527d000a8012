#include "varimap/quality/quality.h"

#include <gtest/gtest.h>

#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"
#include "varimap/mesh/closest_point.h"
#include "varimap/mesh/topology.h"

namespace varimap {
namespace {

using shapes::at_vertices;
using shapes::map_by;

TriangleMesh rectangle(int n, double width, double height) {
    TriangleMesh mesh = shapes::square(n);
    mesh.vertices.col(0) *= width;
    mesh.vertices.col(1) *= height;
    return mesh;
}

void expect_all(const Quantiles& q, double value) {
    for (const double quantile : {q.p01, q.p05, q.p50, q.p95, q.p99}) EXPECT_NEAR(quantile, value, 1e-9);
}

/// A sphere with a long limb upwards.
TriangleMesh sphere_with_limb(int level) {
    TriangleMesh mesh = shapes::ellipsoid(level);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const double z = mesh.vertices(v, 2);
        if (z > 0.9) mesh.vertices(v, 2) = 0.9 + 40 * (z - 0.9);
    }
    return mesh;
}

TEST(WeightedQuantile, CountsWeights) {
    const std::vector<double> values{3, 1, 2}, weights{1, 1, 98};
    EXPECT_EQ(weighted_quantile(values, weights, 0.5), 2);
    EXPECT_EQ(weighted_quantile(values, weights, 0.01), 1);
    EXPECT_EQ(weighted_quantile(values, weights, 0.995), 3);
    EXPECT_EQ(weighted_quantile({}, {}, 0.5), 0);
}

/// Of a mesh onto itself.
double share_within(const PointMap& map, const TriangleMesh& mesh, double bound) {
    return share_within_area_bound(measure_triangles(map, mesh, mesh), mesh, bound);
}

TEST(Quality, StarsKeepAnAreaBoundOrNot) {
    const TriangleMesh mesh = rectangle(10, 1, 1);
    // The left half to a quarter of the width, the right half to the rest: ratios 1/2 and 3/2.
    const PointMap map = map_by(mesh, mesh, [](const Vec3& p) {
        return Vec3(p.x() < 0.5 ? p.x() / 2 : 1.5 * p.x() - 0.5, p.y(), 0);
    });
    EXPECT_EQ(share_within(at_vertices(mesh), mesh, 1), 1);
    EXPECT_EQ(share_within(map, mesh, 2), 1);
    const double kept = share_within(map, mesh, 1.6);  // all but the left half
    EXPECT_GT(kept, 0.5);
    EXPECT_LT(kept, 0.65) << "stars in the middle have both";
    EXPECT_LT(share_within(map, mesh, 1.2), 0.15);
}

/// No finished map keeps areas exactly.
TEST(Quality, AnAreaBoundOfOneIsKeptByAMapThatNearlyKeepsAreas) {
    const TriangleMesh mesh = rectangle(10, 1, 1);
    const auto halves = [&](double ratio) {  // of the left half; of the right one what is left
        const PointMap map = map_by(mesh, mesh, [&](const Vec3& p) {
            return Vec3(p.x() < 0.5 ? ratio * p.x() : (2 - ratio) * p.x() + ratio - 1, p.y(), 0);
        });
        return share_within(map, mesh, 1);
    };
    EXPECT_EQ(halves(0.96), 1);
    EXPECT_LT(halves(0.94), 0.65);
}

TEST(Quality, IdentityIsPerfect) {
    for (const TriangleMesh& mesh : {shapes::ellipsoid(3), rectangle(9, 3, 1), sphere_with_limb(3)}) {
        const PointMap identity = at_vertices(mesh);
        const Distortion d = measure_distortion(identity, mesh, mesh);
        EXPECT_EQ(d.flipped_count, 0);
        EXPECT_EQ(d.collapsed_count, 0);
        EXPECT_EQ(d.flipped_area_percent, 0);
        expect_all(d.area_ratio, 1);
        expect_all(d.conformal_distortion, 1);
        EXPECT_NEAR(d.dirichlet_energy, 1, 1e-12);
        EXPECT_NEAR(measure_coverage(identity, mesh, mesh).share, 1, 1e-12);
        EXPECT_TRUE(measure_coverage(identity, mesh, mesh).parts.empty());
        const RoundTrip round_trip = measure_round_trip(identity, identity, mesh, mesh);
        EXPECT_NEAR(round_trip.mean, 0, 1e-12);
        EXPECT_NEAR(round_trip.p95, 0, 1e-12);
    }
}

TEST(Quality, DoesNotDependOnScaleAndPlace) {
    const TriangleMesh mesh = shapes::ellipsoid(2);
    TriangleMesh moved = mesh;
    moved.vertices *= 250;
    moved.vertices.rowwise() += Eigen::RowVector3d(1e3, -2e3, 5e2);
    const PointMap identity = at_vertices(mesh);
    const Distortion d = measure_distortion(identity, mesh, moved);
    EXPECT_EQ(d.flipped_count, 0);
    expect_all(d.area_ratio, 1);
    EXPECT_NEAR(d.dirichlet_energy, 1, 1e-9);
    EXPECT_NEAR(measure_coverage(identity, mesh, moved).share, 1, 1e-9);
    EXPECT_NEAR(measure_round_trip(identity, identity, moved, mesh).mean, 0, 1e-9);
}

TEST(Quality, MirrorImageIsAllFlipped) {
    const TriangleMesh mesh = shapes::ellipsoid(3);
    const PointMap mirror = map_by(mesh, mesh, [](const Vec3& p) { return Vec3(-p[0], p[1], p[2]); });
    const Distortion d = measure_distortion(mirror, mesh, mesh);
    EXPECT_EQ(d.flipped_count, mesh.face_count());
    EXPECT_NEAR(d.flipped_area_percent, 100, 1e-9);
    EXPECT_EQ(d.collapsed_count, 0);
    expect_all(d.area_ratio, 1);
    EXPECT_NEAR(measure_coverage(mirror, mesh, mesh).share, 1, 1e-12) << "flips are not gaps";
    EXPECT_NEAR(measure_round_trip(mirror, mirror, mesh, mesh).mean, 0, 1e-7);
}

TEST(Quality, StretchHasItsSingularValues) {
    const TriangleMesh source = rectangle(6, 1, 1), target = rectangle(6, 4, 1);
    const PointMap stretch = at_vertices(target);  // at unit areas: sigma = 2 and 1/2
    const Distortion d = measure_distortion(stretch, source, target);
    EXPECT_EQ(d.flipped_count, 0);
    expect_all(d.area_ratio, 1);
    expect_all(d.conformal_distortion, 4);
    EXPECT_NEAR(d.dirichlet_energy, (4 + 0.25) / 2, 1e-9);
}

TEST(Quality, AreaRatioIsImageOverSource) {
    const TriangleMesh mesh = rectangle(8, 1, 1);
    const PointMap shrink = map_by(mesh, mesh, [](const Vec3& p) { return Vec3(p / 2); });
    const Distortion d = measure_distortion(shrink, mesh, mesh);
    expect_all(d.area_ratio, 0.25);
    expect_all(d.conformal_distortion, 1);
    EXPECT_NEAR(d.dirichlet_energy, 0.25, 1e-9);
    EXPECT_NEAR(measure_coverage(shrink, mesh, mesh).share, 0.25, 1e-9);
}

TEST(Quality, CollapsedTrianglesAreFlippedAndFinite) {
    const TriangleMesh mesh = shapes::ellipsoid(2);
    const PointMap point(std::size_t(mesh.vertex_count()), SurfacePoint{5, Vec3(0.2, 0.3, 0.5)});
    const Distortion d = measure_distortion(point, mesh, mesh);
    EXPECT_EQ(d.flipped_count, mesh.face_count());
    EXPECT_EQ(d.collapsed_count, mesh.face_count());
    EXPECT_EQ(d.conformal_distortion.p50, conformal_distortion_cap);
    EXPECT_EQ(d.area_ratio.p99, 0);
    EXPECT_NEAR(d.dirichlet_energy, 0, 1e-12);
    const Coverage coverage = measure_coverage(point, mesh, mesh);
    EXPECT_EQ(coverage.share, 0);
    ASSERT_EQ(coverage.parts.size(), 1u);
    EXPECT_NEAR(coverage.parts[0].share, 1, 1e-12);
}

TEST(Quality, VerticesWithoutImageAreLeftOut) {
    const TriangleMesh mesh = shapes::ellipsoid(2);
    PointMap map = at_vertices(mesh);
    map[0] = {};
    const Distortion d = measure_distortion(map, mesh, mesh);
    EXPECT_EQ(d.flipped_count, 0);
    EXPECT_NEAR(d.dirichlet_energy, 1, 0.1);
    EXPECT_LT(measure_coverage(map, mesh, mesh).share, 1);
    EXPECT_NEAR(measure_round_trip(map, map, mesh, mesh).p95, 0, 1e-12);
}

TEST(Coverage, LargeFacesCoverWhatTheyLieAlong) {
    // Straight images of these faces lie so far from the ring that they seem to leave out a fifth.
    const TriangleMesh coarse = shapes::torus(1, .4, 5, 4), fine = shapes::torus(1, .4, 60, 30);
    const PointMap map = map_by(coarse, fine, [](const Vec3& p) { return p; });
    EXPECT_GT(measure_coverage(map, coarse, fine).share, 0.97);
}

TEST(Coverage, GoodMapsBetweenUnequalMeshesCoverEverything) {
    const auto outward = [](const Vec3& p) { return p; };
    const auto covers = [&](const TriangleMesh& source, const TriangleMesh& target) {
        return measure_coverage(map_by(source, target, outward), source, target).share;
    };
    EXPECT_GT(covers(shapes::ellipsoid(2), shapes::ellipsoid(4)), 0.995);
    EXPECT_GT(covers(shapes::ellipsoid(4), shapes::ellipsoid(2)), 0.995);
    EXPECT_GT(covers(shapes::figure(0.12), shapes::figure(0.12, 0.5)), 0.995);
    EXPECT_GT(covers(shapes::figure(0.12), shapes::figure(0.06)), 0.99);
}

TEST(Coverage, LosesTheAreaOfAMissedLimb) {
    const TriangleMesh mesh = sphere_with_limb(4);
    const auto is_limb = [&](int f, double z) { return position(mesh, {f, Vec3::Constant(1. / 3)})[2] > z; };
    double limb = 0;
    for (int f = 0; f < mesh.face_count(); ++f)
        if (is_limb(f, 0.9)) limb += face_normal(mesh, f).norm() / 2;
    const double share = limb / surface_area(mesh);
    ASSERT_GT(share, 0.15);
    const TriangleMesh ball = shapes::ellipsoid(4);
    const PointMap flattened =
        map_by(ball, mesh, [](const Vec3& p) { return Vec3(p[0], p[1], std::min(p[2], 0.9)); });
    const Coverage coverage = measure_coverage(flattened, ball, mesh);
    EXPECT_NEAR(coverage.share, 1 - share, 0.03);
    ASSERT_EQ(coverage.parts.size(), 1u);
    EXPECT_NEAR(coverage.parts[0].share, share, 0.03);
    EXPECT_GT(mesh.vertex(coverage.parts[0].vertex)[2], 0.9) << "on the limb";
}

/// Two triangles with their right angles at the same vertex, which lies nearest to the middle of both.
TEST(Coverage, NamesTouchingPartsByVerticesOfTheirOwn) {
    const TriangleMesh mesh = shapes::square(4);
    constexpr int touching = 12;
    std::vector<int> left_out;
    TriangleMesh rest = mesh;
    int count = 0;
    for (int f = 0; f < mesh.face_count(); ++f) {
        const Vec3 offset = position(mesh, {f, Vec3::Constant(1. / 3)}) - mesh.vertex(touching);
        const auto corners = mesh.faces.row(f);
        const bool is_right_angle = offset.norm() < 0.12 && (corners.array() == touching).any();
        if (is_right_angle)
            left_out.push_back(f);
        else
            rest.faces.row(count++) = corners;
    }
    ASSERT_EQ(left_out.size(), 2u);
    rest.faces.conservativeResize(count, 3);
    PointMap map;
    for (int v = 0; v < rest.vertex_count(); ++v) map.push_back(point_at_vertex(mesh, v));
    const auto parts = measure_coverage(map, rest, mesh).parts;
    ASSERT_EQ(parts.size(), 2u);
    const auto is_corner = [&](int f, int v) { return (mesh.faces.row(f).array() == v).any(); };
    for (const UncoveredPart& part : parts)
        EXPECT_NE(is_corner(left_out[0], part.vertex), is_corner(left_out[1], part.vertex)) << part.vertex;
    EXPECT_NE(parts[0].vertex, parts[1].vertex);
}

TEST(RoundTrip, MeasuresTheDistance) {
    const TriangleMesh mesh = rectangle(10, 2, 2);
    const PointMap identity = at_vertices(mesh);
    const PointMap shrink = map_by(mesh, mesh, [](const Vec3& p) { return Vec3(p[0], 0.5 * p[1], 0); });
    const RoundTrip round_trip = measure_round_trip(shrink, identity, mesh, mesh);
    EXPECT_NEAR(round_trip.mean, 0.25, 1e-9);  // mean of y/2 over [0, 2], by side length 2
    EXPECT_NEAR(round_trip.p95, 0.475, 0.026);
}

TEST(LandmarkResiduals, AreDistancesBySquareRootOfArea) {
    const TriangleMesh mesh = rectangle(2, 3, 3);
    const auto residuals = landmark_residuals(at_vertices(mesh),
                                              {{point_at_vertex(mesh, 4), point_at_vertex(mesh, 4)},
                                               {point_at_vertex(mesh, 0), point_at_vertex(mesh, 2)}},
                                              mesh, mesh);
    ASSERT_EQ(residuals.size(), 2u);
    EXPECT_NEAR(residuals[0], 0, 1e-12);
    EXPECT_NEAR(residuals[1], 1, 1e-12);
}

TEST(LandmarkResiduals, AreByTheCornersThatHaveAnImage) {
    const TriangleMesh mesh = rectangle(2, 3, 3);
    PointMap map = at_vertices(mesh);
    const SurfacePoint middle{0, Vec3::Constant(1. / 3)};
    const auto residual = [&] { return landmark_residuals(map, {{middle, middle}}, mesh, mesh)[0]; };
    EXPECT_NEAR(residual(), 0, 1e-12);
    map[std::size_t(mesh.faces(0, 0))] = {};
    const Vec3 others = (mesh.vertex(mesh.faces(0, 1)) + mesh.vertex(mesh.faces(0, 2))) / 2;
    EXPECT_NEAR(residual(), (others - position(mesh, middle)).norm() / 3, 1e-12)
        << "by the side of the square";
    map[std::size_t(mesh.faces(0, 1))] = map[std::size_t(mesh.faces(0, 2))] = {};
    EXPECT_EQ(residual(), 0);
}

TEST(LandmarkSurroundings, TellWhereTheMapIsElsewhereAllAroundALandmark) {
    const TriangleMesh mesh = rectangle(2, 3, 3);
    const int v = 4;  // in the middle
    const auto around = [&](const PointMap& map, const SurfacePoint& from, const SurfacePoint& to) {
        return landmark_surroundings(map, {{from, to}}, mesh, mesh)[0];
    };
    const PointMap same = at_vertices(mesh);
    const SurfacePoint middle = point_at_vertex(mesh, v), corner = point_at_vertex(mesh, 0);
    const auto right = around(same, middle, middle);
    EXPECT_LT(right.distance, right.radius);
    PointMap spike = same;
    spike[v] = corner;
    const auto wrong = around(spike, middle, corner);
    EXPECT_NEAR(wrong.radius, right.radius, 1e-12);
    EXPECT_GT(wrong.distance, right.distance + 0.3);
    // Within a face, whose corners are taken along, its surroundings are the vertices beyond them.
    const SurfacePoint inside{0, Vec3::Constant(1. / 3)};
    EXPECT_GT(around(same, inside, inside).radius, 0);
    PointMap nowhere = same;
    for (SurfacePoint& point : nowhere) point.face = -1;
    EXPECT_EQ(around(nowhere, middle, middle).radius, 0);
}

TEST(ExchangedLandmarks, AreThoseWhoseSurroundingsGoToTheOthersPartner) {
    const TriangleMesh mesh = rectangle(8, 3, 3);
    const int a = 30, b = 32, c = 50;  // a and b two edges apart
    const auto exchanged = [&](const std::vector<std::pair<int, int>>& pairs) {
        PointMap map = at_vertices(mesh);
        PointPairs landmarks;
        for (const auto& [from, to] : pairs) {
            map[from] = point_at_vertex(mesh, to);
            landmarks.push_back({point_at_vertex(mesh, from), map[from]});
        }
        return exchanged_landmarks(landmark_surroundings(map, landmarks, mesh, mesh), landmarks, mesh);
    };
    using Pairs = std::vector<std::pair<int, int>>;
    EXPECT_EQ(exchanged({{a, a}, {b, b}, {c, c}}), Pairs());
    EXPECT_EQ(exchanged({{a, b}, {c, c}, {b, a}}), (Pairs{{0, 2}}));
    EXPECT_EQ(exchanged({{a, b}, {b, b}, {c, c}}), Pairs()) << "one is wrong";
    EXPECT_EQ(exchanged({{a, b}, {b, c}, {c, a}}), Pairs()) << "three in a circle";
    EXPECT_EQ(exchanged({}), Pairs());
}

}  // namespace
}  // namespace varimap
