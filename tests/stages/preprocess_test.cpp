#include "stages/preprocess/preprocess.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fixtures/mesh_vertex.h"
#include "fixtures/shapes.h"
#include "varimap/core/error.h"
#include "varimap/mesh/manifold.h"
#include "varimap/mesh/mass.h"
#include "varimap/mesh/thin_faces.h"
#include "varimap/mesh/topology.h"
#include "varimap/spectral/eigenbasis.h"

namespace varimap {
namespace {

using ::testing::HasSubstr;

PreprocessParams with_target(double target) {
    PreprocessParams params;
    params.target_edge_length = target;
    return params;
}

TEST(Preprocess, NormalisesAreaAndCentre) {
    const Surface surface =
        preprocess(shapes::moved(shapes::figure(.15), 17, .4, {9, 8, 7}), with_target(.1));
    EXPECT_NEAR(surface_area(surface.mesh), 1, 1e-12);
    EXPECT_LT(area_centroid(surface.mesh).norm(), 1e-12);
    EXPECT_NEAR(surface.mass.sum(), 1, 1e-13);
    EXPECT_GT(surface.mass.minCoeff(), 0);
    for (int v = 0; v < surface.input.vertex_count(); ++v) {
        const Vec3 expected = (surface.input.vertex(v) - surface.centre) * surface.scale;
        EXPECT_EQ(position(surface.mesh, surface.on_mesh[v]), expected);
    }
}

TEST(Preprocess, ReachesTheAutomaticTarget) {
    const TriangleMesh input = shapes::tube(20, 12, true);
    const Surface surface = preprocess(input, {});
    const double target = 2 * 1.0746 / 50;
    EXPECT_EQ(target_edge_length({}, input.vertex_count()), target);
    for (const auto& [a, b] : find_edges(surface.mesh).vertices)
        EXPECT_LE((surface.mesh.vertex(a) - surface.mesh.vertex(b)).norm(), target * (1 + 1e-9));
    EXPECT_NEAR(target_edge_length({}, 10000), 2 * 1.0746 / 100, 1e-15);
}

TEST(Preprocess, LeavesOutUnusedVerticesAndKeepsTheOrderOfTheOthers) {
    const TriangleMesh full = shapes::ellipsoid(1);
    TriangleMesh sparse = full;  // one unused vertex before each used one
    sparse.vertices = Points::Constant(2 * full.vertex_count(), 3, 77);
    for (int v = 0; v < full.vertex_count(); ++v) sparse.vertices.row(2 * v + 1) = full.vertices.row(v);
    sparse.faces = 2 * full.faces.array() + 1;
    const Surface a = preprocess(full, with_target(.3)), b = preprocess(sparse, with_target(.3));
    EXPECT_EQ(a.mesh.vertices, b.mesh.vertices);
    EXPECT_EQ(a.mesh.faces, b.mesh.faces);
    for (int v = 0; v < full.vertex_count(); ++v) {
        EXPECT_EQ(shapes::mesh_vertex_at(b, {2 * v}).index, -1);
        EXPECT_EQ(shapes::mesh_vertex_at(b, {2 * v + 1}).index, v);
    }
    EXPECT_EQ(b.input.vertices, sparse.vertices);
}

TEST(Preprocess, MovingTurningAndScalingChangeRoundingOnly) {
    const TriangleMesh input = shapes::figure(.15);
    const Surface rest = preprocess(input, with_target(.06));
    for (const double scale : {1e-3, 1., 1e4}) {
        const Surface other =
            preprocess(shapes::moved(input, scale, 2.1, 100 * scale * Vec3(1, -1, .3)), with_target(.06));
        ASSERT_EQ(rest.mesh.faces, other.mesh.faces);
        EXPECT_EQ(rest.input_face, other.input_face);
        const TriangleMesh turned = shapes::moved(rest.mesh, 1, 2.1, Vec3::Zero());
        EXPECT_LT((turned.vertices - other.mesh.vertices).cwiseAbs().maxCoeff(), 1e-12);
        EXPECT_LT((rest.mass - other.mass).cwiseAbs().maxCoeff(), 1e-13);
    }
}

TEST(Preprocess, RefusesATargetThatNeedsTooManyVertices) {
    PreprocessParams params = with_target(.001);
    params.max_vertices = 2000;
    EXPECT_THROW(preprocess(shapes::ellipsoid(2), params), InputError);
}

TEST(Preprocess, MirrorsBothMeshesAndKeepsEveryPointWhereItIs) {
    const TriangleMesh input = shapes::tube(20, 12, true);
    PreprocessParams params;
    const Surface plain = preprocess(input, params);
    params.mirror = true;
    const Surface mirrored = preprocess(input, params);
    EXPECT_TRUE(mirrored.mirrored);
    EXPECT_EQ(mirrored.mesh.vertices, plain.mesh.vertices);
    EXPECT_EQ(mirrored.input.vertices, input.vertices);
    for (int f = 0; f < plain.mesh.face_count(); ++f)
        EXPECT_LT(face_normal(mirrored.mesh, f).dot(face_normal(plain.mesh, f)), 0);
    for (std::size_t v = 0; v < plain.on_input.size(); ++v)
        EXPECT_LT(
            (position(mirrored.input, mirrored.on_input[v]) - position(input, plain.on_input[v])).norm(),
            1e-12);
}

/// How far the way back to the input leads from the mesh at most, units of sqrt(area).
double error_of_way_back(const Surface& surface) {
    double error = 0;
    for (int f = 0; f < surface.mesh.face_count(); ++f)
        for (const Vec3& b : {Vec3(.4, .3, .3), Vec3(1, 0, 0)}) {
            const Vec3 there = position(surface.input, to_input(surface, {f, b}));
            const Vec3 here = position(surface.mesh, {f, b});
            error = std::max(error, ((there - surface.centre) * surface.scale - here).norm());
        }
    return error;
}

TEST(Preprocess, RemovesNeedlesWithoutAreaAndKeepsTheWayBack) {
    TriangleMesh mesh = shapes::ellipsoid(2);
    const int other = vertex_neighbours(mesh)[40][0];
    mesh.vertices.row(40) = mesh.vertices.row(other).eval();
    const Surface surface = preprocess(mesh, {});
    EXPECT_EQ(shapes::mesh_vertex_at(surface, {40}), shapes::mesh_vertex_at(surface, {other}));
    EXPECT_EQ(surface.input.faces, mesh.faces);
    EXPECT_NO_THROW(require_manifold(surface.mesh, "mesh"));
    EXPECT_LT(error_of_way_back(surface), 1e-12);
    for (int f = 0; f < surface.mesh.face_count(); ++f) EXPECT_GT(thinness(surface.mesh, f), 1e-3);
    Surface copy;
    EXPECT_NO_THROW(decode(encode(surface), copy));
}

TEST(Preprocess, RemovesCapsWithoutAreaAndKeepsTheWayBack) {
    int cap;
    const Surface surface = preprocess(shapes::with_cap(shapes::ellipsoid(1), 0, cap), {});
    EXPECT_LT(error_of_way_back(surface), 1e-12);
    EXPECT_EQ(std::count(surface.input_face.begin(), surface.input_face.end(), cap), 0);
    Surface copy;
    EXPECT_NO_THROW(decode(encode(surface), copy));
}

/// A tetrahedron of length 1 and the given height and width.
TriangleMesh sliver(double width) {
    return shapes::make_mesh({{0, 0, 0}, {1, 0, 0}, {.5, width, 0}, {.5, 0, width}},
                             {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
}

TEST(Preprocess, NamesThePlaceOfWhatItCannotRepair) {
    try {
        preprocess(sliver(1e-9), {});
        ADD_FAILURE();
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("the first is face 0"));
    }
}

TEST(Preprocess, NamesFacesByTheirNumbersInTheFile) {
    TriangleMesh file = sliver(1e-9);
    const Faces faces = file.faces;
    file.faces.resize(5, 3);
    file.faces << 1, 1, 2, faces;  // the first has no area and is dropped
    try {
        preprocess(prepared(file, {}, "a.off"), {});
        ADD_FAILURE();
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("the first is face 1;"));
    }
}

TEST(Preprocess, EndsBisectionOfSliversInProportion) {
    EXPECT_EQ(preprocess(sliver(3e-4), {}).mesh.vertex_count(), 10000);
    EXPECT_NO_THROW(compute_eigenbasis(preprocess(sliver(3e-4), {}), {}));
    for (const double width : {1e-4, 1e-5}) try {
            preprocess(sliver(width), {});
            ADD_FAILURE() << width;
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), HasSubstr("is a sliver"));
        }
    const Surface fine = preprocess(sliver(1e-5), with_target(.5));  // on request, any number
    for (const auto& [a, b] : find_edges(fine.mesh).vertices)
        EXPECT_LE((fine.mesh.vertex(a) - fine.mesh.vertex(b)).norm(), .5 * (1 + 1e-9));
}

TEST(Preprocess, ToldRepairsOfAFewElementsKeepTheForm) {
    struct Case {
        int faces;
        RepairCounts counts;
        bool keeps;
    };
    for (const auto& [faces, counts, keeps] : std::vector<Case>{
             {13800, {.cut_edges = 1, .split_vertices = 1}, true},
             {5000, {.cut_edges = 9, .split_vertices = 15}, true},
             {5000, {.cut_edges = 16, .split_vertices = 16}, false},
             {5000, {.split_vertices = 150}, true},
             {5000, {.split_vertices = 151}, false},
             {200, {.degenerate = 10}, true},
             {200, {.degenerate = 11}, false},
             {200, {.not_finite = 4, .duplicates = 4, .closed_slits = 3}, false},
             {13800, {.welded = 5000, .turned = 138}, true},
             {13800, {.turned = 139}, false},
             {13800, {.cut_edges = 1, .dropped_components = 1, .dropped_area = .002}, false},
             {13800, {.cut_edges = 1, .dropped_components = 1, .dropped_area = .0005}, true},
             {13800, {.cavities = 2, .cavity_area = .47}, true},
             {13800, {.cavities = 1, .cavity_area = .6}, false},
             {13800, {.opened_edges = 1}, false},
             {13800, {.filled_holes = 2, .filling_faces = 50}, true},
             {13800, {.filled_holes = 2, .unfilled_holes = 1}, false},
             {13800, {.bridges = 10}, true},
             {13800, {.bridges = 11}, false},
             {13800, {.cut_handles = 1}, false},
         })
        EXPECT_EQ(keeps_the_form(counts, faces, {}), keeps) << faces << ": " << in_words(counts);
    PreprocessParams asked;
    asked.cut_handles = ".1";
    EXPECT_TRUE(keeps_the_form({.cut_handles = 1}, 13800, asked));
}

TEST(Preprocess, ServesTetrahedraAndPlacesFarFromTheOrigin) {
    const TriangleMesh tetrahedron = shapes::make_mesh({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}},
                                                       {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}});
    const Surface rest = preprocess(tetrahedron, {});
    TriangleMesh far = tetrahedron;  // as UTM coordinates are, in metres
    far.vertices.rowwise() += Eigen::RowVector3d(5e5, 5e6, 300);
    const Surface utm = preprocess(far, {});
    EXPECT_EQ(utm.mesh.faces, rest.mesh.faces);
    EXPECT_LT((utm.mesh.vertices - rest.mesh.vertices).cwiseAbs().maxCoeff(), 1e-9);
    for (const double scale : {1e-45, 1e45}) {
        TriangleMesh scaled = tetrahedron;
        scaled.vertices *= scale;
        const Surface surface = preprocess(scaled, {});
        EXPECT_EQ(surface.mesh.faces, rest.mesh.faces);
        EXPECT_LT((surface.mesh.vertices - rest.mesh.vertices).cwiseAbs().maxCoeff(), 1e-12);
        EXPECT_LT(error_of_way_back(surface), 1e-9);
    }
}

}  // namespace
}  // namespace varimap
