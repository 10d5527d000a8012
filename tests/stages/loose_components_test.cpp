#include "stages/explore/loose_components.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "fixtures/known_pair.h"
#include "stages/generate/level_set.h"
#include "varimap/mesh/closest_point.h"
#include "varimap/mesh/interpolation.h"

namespace varimap {
namespace {

using shapes::KnownPair;

double distance_from_segment(const Vec3& p, const Vec3& from, const Vec3& to) {
    const Vec3 along = to - from;
    const double t = std::clamp((p - from).dot(along) / along.squaredNorm(), 0., 1.);
    return (p - from - t * along).norm();
}

bool is_on_bar(const Vec3& p) {
    return p.y() > .65;
}

/// A body, and beside it a bar that is thicker at one end.
TriangleMesh body_and_bar(double cell) {
    const auto f = [](const Vec3& p) {
        const double body = std::min({distance_from_segment(p, {-1, 0, 0}, {1, 0, 0}) - .35,
                                      (p - Vec3(.8, 0, .4)).norm() - .35,
                                      (p - Vec3(-.4, -.3, .3)).norm() - .25}),
                     bar = std::min(distance_from_segment(p, {-.5, 1.25, 0}, {.4, 1.25, 0}) - .12,
                                    (p - Vec3(.45, 1.25, .05)).norm() - .2);
        return std::min(body, bar);
    };
    return shapes::level_set(f, {-1.6, -.9, -.7}, {1.6, 2.1, 1.1}, cell);
}

/// The bar turned in its place, the body as it is.
Points bar_turned(Points points, double angle) {
    const Vec3 centre(0, 1.25, 0);
    const Eigen::AngleAxisd turn(angle, Vec3::UnitZ());
    for (Eigen::Index i = 0; i < points.rows(); ++i)
        if (const Vec3 p = points.row(i).transpose(); is_on_bar(p))
            points.row(i) = (centre + turn * (p - centre)).transpose();
    return points;
}

/// The same in the coordinates of the surfaces' meshes.
Points places_on(const Surface& to, const Surface& from, double angle) {
    const Points input = (from.mesh.vertices / from.scale).rowwise() + from.centre.transpose();
    return (bar_turned(input, angle).rowwise() - to.centre.transpose()) * to.scale;
}

/// Another tessellation whose bar is turned.
KnownPair pair_with_bar_turned(double angle) {
    TriangleMesh other = body_and_bar(.085);
    other.vertices = bar_turned(other.vertices, angle);
    KnownPair pair = shapes::known_pair(body_and_bar(.09), other, {}, 60, {}, 1000);
    pair.A_on_B = places_on(pair.B.surface, pair.A.surface, angle);
    pair.B_on_A = places_on(pair.A.surface, pair.B.surface, -angle);
    return pair;
}

PointMap nearest_points(const Points& places, const TriangleMesh& mesh) {
    const ClosestPoint closest(mesh);
    PointMap map;
    for (Eigen::Index i = 0; i < places.rows(); ++i) map.push_back(closest(places.row(i).transpose()).point);
    return map;
}

/// The map that turns the bar by an angle.
MapPair maps_with_bar_turned(double angle, const KnownPair& pair) {
    const Surface &A = pair.A.surface, &B = pair.B.surface;
    return {nearest_points(places_on(B, A, angle), B.mesh), nearest_points(places_on(A, B, -angle), A.mesh)};
}

/// Mean error after components were laid as the rest.
double error_as_the_rest(MapPair maps, const KnownPair& pair, const PairContext& context) {
    const Appraisal appraisal(context);
    LooseComponents(context, appraisal).lay_as_the_rest(maps);
    return shapes::mean_error(maps, pair);
}

/// A body with two balls in front of it, side by side.
TriangleMesh body_and_eyes(double cell) {
    const auto f = [](const Vec3& p) {
        return std::min({distance_from_segment(p, {-1, 0, 0}, {.6, 0, 0}) - .4,
                         (p - Vec3(-.4, -.3, .3)).norm() - .3, (p - Vec3(.4, .1, .4)).norm() - .3,
                         (p - Vec3(1.5, .4, .1)).norm() - .25, (p - Vec3(1.5, -.4, .1)).norm() - .25});
    };
    return shapes::level_set(f, {-1.6, -.9, -.7}, {2, .9, 1.1}, cell);
}

/// The nearest points, where the eyes, beyond 1.15 along the body, are moved to each other's place.
PointMap eyes_exchanged(const Surface& from, const Surface& to, bool exchanged) {
    Points places = (from.mesh.vertices / from.scale).rowwise() + from.centre.transpose();
    for (Eigen::Index i = 0; i < places.rows(); ++i)
        if (exchanged && places(i, 0) > 1.15) places(i, 1) += places(i, 1) > 0 ? -.8 : .8;
    return nearest_points((places.rowwise() - to.centre.transpose()) * to.scale, to.mesh);
}

TEST(LooseComponents, AreExchangedWhereTheyLieAsEachOther) {
    const KnownPair pair = shapes::known_pair(body_and_eyes(.09), body_and_eyes(.085), {}, 60, {}, 1000);
    const Surface &A = pair.A.surface, &B = pair.B.surface;
    ASSERT_EQ(SurfaceComponents(A).count(), 3);
    const PairContext context = pair.context();
    const auto error_after = [&](MapPair maps) {
        LooseComponents(context, Appraisal(context)).lay_as_the_rest(maps);
        return (positions(B.mesh, maps.A_to_B) - positions(B.mesh, eyes_exchanged(A, B, false)))
            .rowwise()
            .norm()
            .mean();
    };
    const MapPair right{eyes_exchanged(A, B, false), eyes_exchanged(B, A, false)},
        wrong{eyes_exchanged(A, B, true), eyes_exchanged(B, A, true)};
    EXPECT_LT(error_after(right), .01);
    EXPECT_LT(error_after(wrong), .01);
    EXPECT_GT((positions(B.mesh, wrong.A_to_B) - positions(B.mesh, right.A_to_B)).rowwise().norm().mean(),
              .02);
}

TEST(LooseComponents, AreThoseThatBridgesJoin) {
    const KnownPair pair = pair_with_bar_turned(0);
    const SurfaceComponents both(pair.A.surface);
    ASSERT_EQ(both.count(), 2);
    EXPECT_TRUE(both.are_several());
    const int bar = 1 - both.largest();
    EXPECT_NEAR(both.area(0) + both.area(1), 1, .02);  // the bridge has the rest
    for (const int v : both.vertices(bar)) EXPECT_GT(both.mesh().vertex(v).y(), 0);
    EXPECT_LT(both.faces(0).size() + both.faces(1).size(), std::size_t(both.mesh().face_count()));
    EXPECT_FALSE(SurfaceComponents(shapes::figure_pair(.2, false, 300).A.surface).are_several());
}

TEST(LooseComponents, AreTurnedAsTheRest) {
    const KnownPair pair = pair_with_bar_turned(0);
    const PairContext context = pair.context();
    const MapPair reversed = maps_with_bar_turned(std::numbers::pi, pair);
    const double before = shapes::mean_error(reversed, pair);
    EXPECT_GT(before, .03);
    EXPECT_LT(error_as_the_rest(reversed, pair, context), .02);
}

TEST(LooseComponents, OfMirrorImagesAreTurnedAsTheRest) {
    KnownPair pair = pair_with_bar_turned(0);
    const MapPair reversed = maps_with_bar_turned(std::numbers::pi, pair);
    // As --mirror leaves it: its faces look inward.
    pair.B.surface.mesh.vertices.col(1) *= -1;
    pair.A_on_B.col(1) *= -1;
    const PairContext context = pair.context();
    EXPECT_GT(shapes::mean_error(reversed, pair), .03);
    EXPECT_LT(error_as_the_rest(reversed, pair, context), .02);
}

/// Of the map that leads the bar end for end, with one landmark.
void expect_unturned(const KnownPair& pair, int a, int b) {
    const MapPair reversed = maps_with_bar_turned(std::numbers::pi, pair);
    const PairContext context(pair.A, pair.B, {{MeshVertex{a}, MeshVertex{b}}});
    EXPECT_EQ(error_as_the_rest(reversed, pair, context), shapes::mean_error(reversed, pair));
}

TEST(LooseComponents, StayWhereTheyHaveLandmarks) {
    const KnownPair pair = pair_with_bar_turned(0);
    const SurfaceComponents A(pair.A.surface), B(pair.B.surface);
    const int bar_A = 1 - A.largest(), bar_B = 1 - B.largest();
    expect_unturned(pair, A.vertices(bar_A).front(), B.vertices(B.largest()).front());
    expect_unturned(pair, A.vertices(A.largest()).front(), B.vertices(bar_B).front());
}

TEST(LooseComponents, StayWhereTheyDoLieOtherwise) {
    const KnownPair pair = pair_with_bar_turned(std::numbers::pi / 2);
    const MapPair right = maps_with_bar_turned(std::numbers::pi / 2, pair);
    EXPECT_LT(shapes::mean_error(right, pair), .01);
    EXPECT_EQ(error_as_the_rest(right, pair, pair.context()), shapes::mean_error(right, pair));
}

/// A box of half sizes `half`, a little rounded.
double distance_from_box(const Vec3& p, const Vec3& middle, const Vec3& half) {
    constexpr double round = .04;
    const Vec3 beyond = (p - middle).cwiseAbs() - half + Vec3::Constant(round);
    return beyond.cwiseMax(0).norm() + std::min(beyond.maxCoeff(), 0.) - round;
}

/// A square seat, a back behind it, and four legs below, none of which touches another.
TriangleMesh chair(double cell) {
    const auto f = [](const Vec3& p) {
        double nearest = std::min(distance_from_box(p, {0, 0, 0}, {1, 1, .12}),
                                  distance_from_box(p, {0, .88, 1.2}, {1, .12, .9}));
        for (const double x : {-.85, .85})
            for (const double y : {-.85, .85})
                nearest = std::min(nearest, distance_from_box(p, {x, y, -1}, {.15, .15, .7}));
        return nearest;
    };
    return shapes::level_set(f, {-1.3, -1.3, -2}, {1.3, 1.3, 2.4}, cell);
}

/// The nearest points, where all below the back is turned by so many quarters about the vertical axis.
PointMap seat_turned(const Surface& from, const Surface& to, int quarters) {
    Points places = (from.mesh.vertices / from.scale).rowwise() + from.centre.transpose();
    const Eigen::AngleAxisd turn(quarters * std::numbers::pi / 2, Vec3::UnitZ());
    for (Eigen::Index i = 0; i < places.rows(); ++i)
        if (places(i, 2) < .21) places.row(i) = (turn * Vec3(places.row(i).transpose())).transpose();
    return nearest_points((places.rowwise() - to.centre.transpose()) * to.scale, to.mesh);
}

/// Distances over bridges would not: these are where rounding has the components nearest.
TEST(LooseComponents, LieToEachOtherAsStraightDistancesTell) {
    const KnownPair pair = shapes::known_pair(chair(.11), chair(.1), {}, 60, {}, 1000);
    const Surface &A = pair.A.surface, &B = pair.B.surface;
    ASSERT_EQ(SurfaceComponents(A).count(), 6);
    const PairContext context = pair.context();
    const Appraisal appraisal(context);
    const auto stretch = [&](int quarters) {
        return appraisal.cues({seat_turned(A, B, quarters), seat_turned(B, A, -quarters)}).stretch;
    };
    EXPECT_LT(stretch(0), .03);
    EXPECT_GT(stretch(1), .06);
    EXPECT_GT(stretch(2), .06);
}

}  // namespace
}  // namespace varimap
