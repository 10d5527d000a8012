#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"
#include "fixtures/transfer.h"
#include "stages/transfer/shape.h"
#include "varimap/mesh_files/mesh_file.h"

namespace varimap {
namespace {

using namespace transfers;
using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(Transfer, CarriesShapesWhoseMaterialsAreNotThere) {
    TransferRequest request;
    request.mesh = write("b.obj", obj_of(ball_, unwrapped(ball_), "skin.mtl"));
    const auto files = carry(request, identity_onto(ball_));
    ASSERT_EQ(files.size(), 1u);
    const std::string& shape = files.begin()->second;
    EXPECT_THAT(shape, Not(HasSubstr("mtllib")));
    EXPECT_EQ(parse_mesh(shape, "b.obj").faces, ball_.faces);
}

TEST_F(Transfer, CarriesAShapeExactlyToAMovedCopy) {
    const Correspondence map = moved_copy(ball_);
    TriangleMesh smile = ball_;
    for (auto p : smile.vertices.rowwise())
        p += .2 * std::exp(-4 * (p - smile.vertices.row(3)).squaredNorm()) * p;
    const Points truth = shapes::shuffled(shapes::moved(smile, 3, 1.2, {1, -2, 3}), 7).vertices;
    EXPECT_LT((carry_shape(map, smile.vertices) - truth).rowwise().norm().maxCoeff(), 2e-3 * .2 * 3);
}

TEST_F(Transfer, CarriesAShapeInTheFramesOfAnotherPose) {
    // A swelling along normals stays one, wherever the limbs point.
    const PosedPair pair;
    Points swollen = pair.rest.vertices + .05 * vertex_normals(pair.rest);
    const Points moved = carry_shape(pair.map, swollen);
    const Points truth = .05 * vertex_normals(pair.map.to);
    const Eigen::VectorXd error = (moved - pair.map.to.vertices - truth).rowwise().norm() / .05;
    EXPECT_LT(error.mean(), .15);
}

/// Makes the identity a map onto the mirrored mesh, whose faces look outward, too.
void mirror(Correspondence& map) {
    map.to.vertices.col(0) *= -1;
    map.to.faces.col(1).swap(map.to.faces.col(2));
    for (SurfacePoint& image : map.there) std::swap(image.barycentric[1], image.barycentric[2]);
}

/// A ball and a small one beside it, which is not in the map.
struct WithEye {
    TriangleMesh both;
    Correspondence map;

    WithEye(const TriangleMesh& ball, bool mirrored) {
        const TriangleMesh eye = shapes::moved(shapes::ellipsoid(1), .05, .4, {.3, .7, .5});
        const int n = ball.vertex_count();
        both = {Points(n + eye.vertex_count(), 3), Faces(ball.face_count() + eye.face_count(), 3)};
        both.vertices << ball.vertices, eye.vertices;
        both.faces << ball.faces, eye.faces.array() + n;
        map = identity_onto(both);
        for (int v = n; v < both.vertex_count(); ++v)
            map.there[std::size_t(v)] = map.back[std::size_t(v)] = {};
        if (mirrored) mirror(map);
        map.to = shapes::moved(map.to, 3, 1.2, {1, -2, 3});
    }
};

TEST_F(Transfer, WhatWasLeftOutOfTheMapFollowsItsNeighbours) {
    for (const bool mirrored : {false, true}) {
        const WithEye pair(ball_, mirrored);
        EXPECT_LT((carried_vertices(pair.map) - pair.map.to.vertices).rowwise().norm().maxCoeff(), 1e-9)
            << mirrored;
    }
}

TEST_F(Transfer, AShapeMovesWhatWasLeftOutOfTheMap) {
    const WithEye pair(ball_, false);
    TriangleMesh risen = pair.both;
    risen.vertices.col(2).array() += .3;
    const Points truth = shapes::moved(risen, 3, 1.2, {1, -2, 3}).vertices;
    EXPECT_LT((carry_shape(pair.map, risen.vertices) - truth).rowwise().norm().maxCoeff(), .01);
}

TEST_F(Transfer, AShapeMovesAsMuchBesideWhatHasNoImage) {
    const TriangleMesh plane = shapes::square(20);
    Correspondence half = identity_onto(plane);
    const double middle = plane.vertices.col(0).mean();
    for (int v = 0; v < plane.vertex_count(); ++v)
        if (plane.vertices(v, 0) > middle) half.back[std::size_t(v)] = {};
    const Points risen = plane.vertices.rowwise() + Eigen::RowVector3d(0, 0, .1);
    EXPECT_LT((carry_shape(half, risen) - risen).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_F(Transfer, AShapeMayLieElsewhere) {
    Correspondence map = identity_onto(ball_);
    map.to_file = "b.ply";
    TriangleMesh bulging = ball_;
    bulging.vertices.row(5) *= 1.1;
    EXPECT_FALSE(laid_onto(ball_, bulging.vertices));
    const Points away = shapes::moved(bulging, 1000, 1.5, {4, 5, 6}).vertices;
    EXPECT_LT((laid_onto(ball_, away).value().vertices - bulging.vertices).rowwise().norm().maxCoeff(), 1e-9);
    TriangleMesh bent = ball_;
    bent.vertices.col(2).array() += bent.vertices.col(0).array().square();
    EXPECT_FALSE(laid_onto(ball_, bent.vertices)) << "its motion is not one of the whole";
    TransferRequest request;
    request.shapes = {write("away.ply", to_ply({away, ball_.faces}))};
    EXPECT_THAT(warnings_of(request, map), HasSubstr("lies elsewhere than a.obj"));
    EXPECT_FALSE(laid_onto(ball_, away).value().is_mirror_image);
    TriangleMesh exchanged = bulging;
    exchanged.vertices.col(1).swap(exchanged.vertices.col(2));
    EXPECT_TRUE(laid_onto(ball_, exchanged.vertices).value().is_mirror_image);
    request.shapes = {write("exchanged.ply", to_ply(exchanged))};
    EXPECT_THAT(refusal(request, map), HasSubstr("is a mirror image of a.obj, or has two axes exchanged"));
}

/// The part that moves does so as a whole: the best similarity of all vertices would take much of that away.
TEST_F(Transfer, AnExpressionStaysWholeInOtherAxesAndUnits) {
    TriangleMesh turned = ball_;
    for (auto vertex : turned.vertices.rowwise())
        if (vertex[2] > .4) vertex << -vertex[0], -vertex[1], vertex[2] + .8;
    EXPECT_FALSE(laid_onto(ball_, turned.vertices)) << "most vertices lie where they were";
    Points other_axes(ball_.vertex_count(), 3);
    other_axes << 100 * turned.vertices.col(0), -100 * turned.vertices.col(2), 100 * turned.vertices.col(1);
    const LaidShape laid = laid_onto(ball_, other_axes).value();
    EXPECT_LT((laid.vertices - turned.vertices).rowwise().norm().maxCoeff(), 1e-9);
    EXPECT_FALSE(laid.is_mirror_image);
}

/// Of values of the vertices of a mesh, those of the corners of its faces.
Points at_corners(const Points& values, const TriangleMesh& mesh) {
    Points result(3 * mesh.face_count(), 3);
    for (int i = 0; i < result.rows(); ++i) result.row(i) = values.row(mesh.faces(i / 3, i % 3));
    return result;
}

TEST_F(Transfer, AShapeIsCarriedAlikeWhereEveryFaceHasVerticesOfItsOwn) {
    const PosedPair pair;
    const Points swollen = pair.rest.vertices + .05 * vertex_normals(pair.rest);
    const Points whole = carry_shape(pair.map, swollen);
    const Points split = carry_shape(split_at_edges(pair.map), at_corners(swollen, pair.rest));
    EXPECT_LT((split - at_corners(whole, pair.map.to)).rowwise().norm().maxCoeff(), 1e-9);
}

TEST_F(Transfer, WhatWasLeftOutStaysWholeWhereEveryFaceHasVerticesOfItsOwn) {
    WithEye pair(ball_, false);
    pair.map.to.vertices.col(0) *= 1.3;  // no similarity takes the ball's surroundings there
    const Points carried = carried_vertices(split_at_edges(pair.map));
    Points first = Points::Constant(pair.both.vertex_count(), 3, NAN);
    for (int i = 0; i < carried.rows(); ++i) {
        auto there = first.row(pair.both.faces(i / 3, i % 3));
        if (there.hasNaN()) there = carried.row(i);
        ASSERT_LT((carried.row(i) - there).norm(), 1e-9) << "corner " << i;
    }
}

TEST_F(Transfer, SaysHowManyVerticesFollowTheirNeighbours) {
    const WithEye pair(ball_, false);
    const ObjModel plain{{},
                         Faces::Constant(pair.both.face_count(), 3, -1),
                         std::vector<int>(std::size_t(pair.both.face_count()), -1),
                         {},
                         {}};
    TransferRequest request;
    request.mesh = write("a.obj", obj_of(pair.both, plain));
    EXPECT_THAT(warnings_of(request, pair.map), HasSubstr("a.obj: 42 vertices have no image; they follow"));
    request = {};
    request.shapes = {folder_ / "a.obj"};
    Correspondence map = pair.map;
    map.to_file = "b.off";
    EXPECT_THAT(warnings_of(request, map), HasSubstr("b.off: 42 vertices have no image; they follow"));
}

TEST_F(Transfer, AMirroringMapTurnsPolygons) {
    Correspondence map = identity_onto(ball_);
    mirror(map);
    std::string obj;
    for (const auto p : ball_.vertices.rowwise()) obj += fmt::format("v {} {} {}\n", p[0], p[1], p[2]);
    obj += "vt 0 0\nvt 1 0\nvt 0 1\n";
    for (const auto f : ball_.faces.rowwise())
        obj += fmt::format("f {}/1 {}/2 {}/3\n", f[0] + 1, f[1] + 1, f[2] + 1);
    TransferRequest request;
    request.mesh = write("a.obj", obj);
    const std::string text = carry(request, map).at("source_on_target.obj");
    const TriangleMesh mesh = parse_mesh(text, "a.obj");
    EXPECT_EQ(mesh.faces, map.to.faces);
    EXPECT_LT((mesh.vertices - map.to.vertices).norm(), 1e-9);
    EXPECT_THAT(text, HasSubstr(fmt::format("f {}/1 {}/3 {}/2\n", ball_.faces(0, 0) + 1,
                                            ball_.faces(0, 2) + 1, ball_.faces(0, 1) + 1)));
}

TEST_F(Transfer, TellsAnotherOrderFromAnotherMesh) {
    const TriangleMesh other = shapes::shuffled(ball_, 7);
    TransferRequest request;
    request.shapes = {write("c.ply", to_ply(other))};
    EXPECT_THAT(refusal(request, identity_onto(ball_)),
                HasSubstr("as many vertices and triangles, but in another order"));
}

TEST_F(Transfer, CarriesTheSourcesPolygons) {
    std::string obj = "# SPACE=LPS\nmtllib none.mtl\n";
    for (const auto p : ball_.vertices.rowwise())
        obj += fmt::format("v {} {} {} .5 .5 .5\n", p[0], p[1], p[2]);
    obj += "vn 0 0 1\nvt 0 0\ng head\n";
    for (const auto f : ball_.faces.rowwise())
        obj += fmt::format("f {}/1/1 {}/1/1 {}//1\n", f[0] + 1, f[1] + 1, f[2] + 1);
    write("none.mtl", "newmtl a\n");
    TransferRequest request;
    request.mesh = write("quads.obj", obj);
    Correspondence map = moved_copy(ball_);
    map.to.space = Space::ras;
    const auto files = carry(request, map);
    const std::string& text = files.at("source_on_target.obj");
    EXPECT_THAT(text, HasSubstr("g head"));
    EXPECT_EQ(text.find("vn"), std::string::npos);
    EXPECT_EQ(text.find("/1/1"), std::string::npos);
    const TriangleMesh mesh = parse_mesh(text, "a.obj");
    EXPECT_EQ(mesh.faces, ball_.faces);
    EXPECT_EQ(mesh.space, Space::ras);
    const Points truth = shapes::moved(ball_, 3, 1.2, {1, -2, 3}).vertices;
    EXPECT_LT((mesh.vertices - truth).rowwise().norm().maxCoeff(), 1e-9);
}

}  // namespace
}  // namespace varimap
