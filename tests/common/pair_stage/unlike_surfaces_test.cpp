#include "varimap/pair_stage/unlike_surfaces.h"

#include <gtest/gtest.h>

#include <random>

#include "stages/preprocess/preprocess.h"
#include "tests/fixtures/shapes.h"
#include "tests/fixtures/together.h"
#include "varimap/core/logged.h"
#include "varimap/mesh/boundary.h"
#include "varimap/mesh/topology.h"

namespace varimap {
namespace {

Surface ball(bool inside_out, bool mirrored) {
    TriangleMesh mesh = shapes::ellipsoid(2);
    if (inside_out) mesh.faces.col(1).swap(mesh.faces.col(2));
    PreprocessParams params;
    params.mirror = mirrored;
    return preprocess(mesh, params);
}

template <class Warner>
std::size_t warnings_of(const Surface& A, const Surface& B, Warner warner) {
    const std::size_t before = logged_warnings().size();
    warner(A, B);
    return logged_warnings().size() - before;
}

std::size_t warnings_of(const Surface& A, const Surface& B) {
    return warnings_of(A, B, warn_of_inside_out);
}

/// The unit ball below a height.
TriangleMesh cut_ball(double height) {
    const TriangleMesh ball = shapes::ellipsoid(4);
    std::vector<int> left;
    for (int f = 0; f < ball.face_count(); ++f)
        if (ball.vertices(ball.faces.row(f), 2).maxCoeff() < height) left.push_back(f);
    return {ball.vertices, ball.faces(left, Eigen::all)};
}

Surface ball_cut_at(double height) {
    return preprocess(cut_ball(height), {});
}

/// Without half of it or a small part, but not where both are open, nor for a hole, .43 long.
TEST(UnlikeSurfaces, PartsAreSaid) {
    const Surface whole = ball(false, false), half = ball_cut_at(0), nearly = ball_cut_at(.85),
                  holed = ball_cut_at(.97);
    for (const Surface& part : {half, nearly}) {
        ASSERT_EQ(warnings_of(part, whole, warn_of_part), 1u);
        EXPECT_NE(logged_warnings().back().find("the source looks like a part"), std::string::npos);
        ASSERT_EQ(warnings_of(whole, part, warn_of_part), 1u);
        EXPECT_NE(logged_warnings().back().find("the target looks like a part"), std::string::npos);
        EXPECT_EQ(warnings_of(part, part, warn_of_part), 0u);
    }
    Surface cut = half;
    cut.link = link_to_itself(half.input);
    cut.link.fate.front() = VertexFate::outside_part;
    EXPECT_EQ(warnings_of(cut, whole, warn_of_part), 0u) << "it was cut to its part";
    EXPECT_EQ(warnings_of(holed, whole, warn_of_part), 0u);
    EXPECT_EQ(warnings_of(whole, whole, warn_of_part), 0u);
}

/// A strip of 2 by 1, rolled up by an angle.
TriangleMesh rolled(double angle) {
    constexpr int n = 20, m = 10;
    TriangleMesh mesh{Points((n + 1) * (m + 1), 3), Faces(2 * n * m, 3)};
    for (int i = 0, f = 0; i <= n; ++i)
        for (int k = 0; k <= m; ++k) {
            const int v = i * (m + 1) + k;
            const double at = 2. * i / n, turn = angle * at / 2;
            const double x = angle > 0 ? 2 * std::sin(turn) / angle : at;
            mesh.vertices.row(v) << x, double(k) / m, angle > 0 ? 2 * (1 - std::cos(turn)) / angle : 0;
            if (i == n || k == m) continue;
            mesh.faces.row(f++) << v, v + m + 1, v + m + 2;
            mesh.faces.row(f++) << v, v + m + 2, v + 1;
        }
    return mesh;
}

TEST(UnlikeSurfaces, ARolledSheetIsNoPartOfAFlatOne) {
    const Surface flat = preprocess(rolled(0), {}), curled = preprocess(rolled(3), {});
    EXPECT_EQ(warnings_of(flat, curled, warn_of_part), 0u);
    EXPECT_EQ(warnings_of(curled, flat, warn_of_part), 0u);
}

/// Without so many of its faces, holes of .04 sqrt(area) that do not touch: those at vertices far apart.
TriangleMesh without_faces(TriangleMesh mesh, int count) {
    const Adjacency neighbours = vertex_neighbours(mesh);
    std::vector<char> keep(std::size_t(mesh.face_count()), 1), near_hole(std::size_t(mesh.vertex_count()), 0);
    for (const auto& [a, b] : find_boundary(mesh).edges)
        near_hole[std::size_t(a)] = near_hole[std::size_t(b)] = 1;
    for (int f = 0; f < mesh.face_count() && count > 0; ++f) {
        const auto corners = mesh.faces.row(f);
        if (std::any_of(corners.begin(), corners.end(), [&](int v) { return near_hole[std::size_t(v)]; }))
            continue;
        for (const int v : corners)
            for (const int w : neighbours[v]) near_hole[std::size_t(w)] = 1;
        keep[std::size_t(f)] = 0;
        --count;
    }
    std::vector<int> left;
    for (int f = 0; f < mesh.face_count(); ++f)
        if (keep[std::size_t(f)]) left.push_back(f);
    mesh.faces = mesh.faces(left, Eigen::all).eval();
    return mesh;
}

TEST(UnlikeSurfaces, HolesAreNamedWhereAnOpeningMayBeOne) {
    const auto asked = [](const TriangleMesh& part) {
        EXPECT_EQ(warnings_of(preprocess(part, {}), ball(false, false), warn_of_part), 1u);
        return logged_warnings().back().find("--fill-holes") != std::string::npos;
    };
    EXPECT_FALSE(asked(cut_ball(0)));
    EXPECT_TRUE(asked(cut_ball(.9)));
    EXPECT_TRUE(asked(shapes::tube(20, 12, false))) << "it ends at two loops";
    EXPECT_FALSE(asked(without_faces(cut_ball(0), 8)));
    EXPECT_TRUE(asked(without_faces(cut_ball(0), 9))) << "its rim is the tenth loop";
}

/// A ball without caps at so many corners of an icosahedron.
Surface ball_with_holes(int holes) {
    const TriangleMesh ball = shapes::ellipsoid(4), corners = shapes::ellipsoid(0);
    std::vector<int> left;
    for (int f = 0; f < ball.face_count(); ++f) {
        const Vec3 at = position(ball, {f, Vec3::Constant(1.0 / 3)});
        const auto distances = (corners.vertices.topRows(holes).rowwise() - at.transpose()).rowwise().norm();
        if (distances.minCoeff() > .3) left.push_back(f);
    }
    return preprocess(TriangleMesh{ball.vertices, ball.faces(left, Eigen::all)}, {});
}

TEST(UnlikeSurfaces, HolesOfBothAtOtherPlacesAreSaid) {
    const Surface three = ball_with_holes(3), five = ball_with_holes(5);
    EXPECT_EQ(warnings_of(three, three, warn_of_part), 0u);
    ASSERT_EQ(warnings_of(three, five, warn_of_part), 1u);
    EXPECT_NE(logged_warnings().back().find("open at 3 and 5 long loops"), std::string::npos);
    EXPECT_NE(logged_warnings().back().find("--fill-holes all"), std::string::npos);
    EXPECT_EQ(warnings_of(ball_with_holes(1), five, warn_of_part), 0u);
}

TEST(UnlikeSurfaces, WhatIsWornMayBeOpen) {
    TriangleMesh hat = cut_ball(0);
    hat.vertices = (0.4 * hat.vertices).rowwise() + Eigen::RowVector3d(0, 0, 1.5);
    const auto surface = [](const TriangleMesh& mesh) { return preprocess(prepared(mesh, {}, ""), {}); };
    const Surface body = ball(false, false);
    EXPECT_EQ(warnings_of(surface(hat), body, warn_of_part), 1u);
    EXPECT_EQ(warnings_of(surface(shapes::together(shapes::ellipsoid(4), hat)), body, warn_of_part), 0u);
    EXPECT_EQ(warnings_of(surface(shapes::together(cut_ball(0), hat)), body, warn_of_part), 1u);
}

TEST(UnlikeSurfaces, OtherGenusIsSaid) {
    const Surface sphere = ball(false, false), torus = preprocess(shapes::torus(1, .4, 24, 12), {}),
                  tube = preprocess(shapes::tube(8, 8, false), {});
    EXPECT_EQ(warnings_of(sphere, tube, warn_of_genus), 0u);
    EXPECT_EQ(warnings_of(torus, torus, warn_of_genus), 0u);
    ASSERT_EQ(warnings_of(torus, sphere, warn_of_genus), 1u);
    EXPECT_NE(logged_warnings().back().find("the source has genus 1, the target 0"), std::string::npos);
}

TEST(UnlikeSurfaces, OneInsideOutIsSaid) {
    const Surface out = ball(false, false), in = ball(true, false);
    EXPECT_EQ(warnings_of(out, out), 0u);
    EXPECT_EQ(warnings_of(in, in), 0u);
    ASSERT_EQ(warnings_of(in, out), 1u);
    EXPECT_NE(logged_warnings().back().find("the source is inside out"), std::string::npos);
    ASSERT_EQ(warnings_of(out, in), 1u);
    EXPECT_NE(logged_warnings().back().find("the target is inside out"), std::string::npos);
    // --mirror is the user's word on it.
    EXPECT_EQ(warnings_of(ball(true, true), out), 0u);
    EXPECT_EQ(warnings_of(ball(false, true), out), 0u);
}

/// Of what is open, too, unless it is a sheet, which has no inside.
TEST(UnlikeSurfaces, OneInsideOutIsSaidOfOpenSurfaces) {
    const auto turned = [](TriangleMesh mesh) {
        mesh.faces.col(1).swap(mesh.faces.col(2));
        return mesh;
    };
    const Surface whole = ball(false, false), open = ball_cut_at(.85),
                  inward = preprocess(turned(cut_ball(.85)), {});
    EXPECT_EQ(warnings_of(open, whole), 0u);
    ASSERT_EQ(warnings_of(inward, whole), 1u);
    EXPECT_NE(logged_warnings().back().find("the source is inside out"), std::string::npos);
    ASSERT_EQ(warnings_of(open, inward), 1u);
    EXPECT_NE(logged_warnings().back().find("the target is inside out"), std::string::npos);
    const Surface bowl = preprocess(cut_ball(-.5), {}), turned_bowl = preprocess(turned(cut_ball(-.5)), {});
    EXPECT_EQ(warnings_of(bowl, turned_bowl), 0u);
}

/// A ball onto itself, vertex v to `image(v, random)`.
template <class Image>
std::size_t warnings_of_map(const Surface& ball, Image image) {
    std::mt19937 random(1);
    PointPairs pairs;
    for (int v = 0; v < ball.input.vertex_count(); ++v)
        pairs.emplace_back(point_at_vertex(ball.input, v), point_at_vertex(ball.input, image(v, random)));
    return warnings_of(ball, ball,
                       [&](const Surface& A, const Surface& B) { warn_of_bad_initial_map(pairs, A, B); });
}

TEST(UnlikeSurfaces, MirroredInitialMapsAreSaid) {
    const Surface ball = preprocess(shapes::ellipsoid(3), {});
    const auto mirrored = [&](int v, std::mt19937&) {
        const Vec3 across(-ball.input.vertices(v, 0), ball.input.vertices(v, 1), ball.input.vertices(v, 2));
        Eigen::Index nearest = 0;
        (ball.input.vertices.rowwise() - across.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
        return int(nearest);
    };
    ASSERT_EQ(warnings_of_map(ball, mirrored), 1u);
    EXPECT_NE(logged_warnings().back().find("left and right exchanged"), std::string::npos);
}

TEST(UnlikeSurfaces, MapsWithoutShapeAreSaid) {
    const Surface ball = preprocess(shapes::ellipsoid(3), {});
    const int count = ball.input.vertex_count();
    const auto any = [&](std::mt19937& random) { return int(random() % unsigned(count)); };
    EXPECT_EQ(warnings_of_map(ball, [](int v, std::mt19937&) { return v; }), 0u);
    EXPECT_EQ(warnings_of_map(ball, [](int v, std::mt19937&) { return v - v % 20; }), 0u);
    EXPECT_EQ(warnings_of_map(ball, [&](int v, std::mt19937& random) { return v % 5 ? v : any(random); }),
              0u);
    ASSERT_EQ(warnings_of_map(ball, [](int, std::mt19937&) { return 7; }), 1u);
    EXPECT_NE(logged_warnings().back().find("to one place of the target"), std::string::npos);
    ASSERT_EQ(warnings_of_map(ball, [&](int, std::mt19937& random) { return any(random); }), 1u);
    EXPECT_NE(logged_warnings().back().find("as a random one does"), std::string::npos);
}

}  // namespace
}  // namespace varimap
