#include "varimap/pair_stage/pair_inputs.h"

#include <gtest/gtest.h>

#include <set>

#include "fixtures/shapes.h"
#include "stages/coarsen/coarsen.h"
#include "stages/preprocess/preprocess.h"
#include "varimap/core/error.h"
#include "varimap/mesh/topology.h"
#include "varimap/pair_stage/landmark_vertices.h"

namespace varimap {
namespace {

class PairLandmarks : public testing::Test {
  protected:
    static const Surface& surface() {
        static const Surface made = [] {
            CoarsenParams params;
            params.vertices = 500;
            return coarsened(preprocess(shapes::figure(.15), {}), params);
        }();
        return made;
    }
    /// Input vertices that lie on a face, not at vertices of the mesh; by `count` on one face.
    static std::vector<InputVertex> inside_one_face(int count) {
        std::vector<std::vector<InputVertex>> on_face(std::size_t(surface().mesh.face_count()));
        for (int v = 0; v < surface().input.vertex_count(); ++v) {
            const SurfacePoint& at = surface().on_mesh[std::size_t(v)];
            if (vertex_of(surface().mesh, at) < 0) on_face[std::size_t(at.face)].push_back({v});
        }
        for (auto& vertices : on_face)
            if (int(vertices.size()) >= count) {
                vertices.resize(std::size_t(count));
                return vertices;
            }
        return {};
    }
    static VertexPairs<InputVertex> onto_themselves(const std::vector<InputVertex>& vertices) {
        VertexPairs<InputVertex> pairs;
        for (const InputVertex v : vertices) pairs.emplace_back(v, v);
        return pairs;
    }
};

TEST_F(PairLandmarks, StandAtDifferentCornersOfTheirFace) {
    const auto pairs = onto_themselves(inside_one_face(3));
    ASSERT_EQ(pairs.size(), 3u);
    const auto vertices = to_mesh_vertices(pairs, surface(), surface());
    EXPECT_NE(vertices[0].first, vertices[1].first);
    EXPECT_NE(vertices[0].first, vertices[2].first);
    EXPECT_NE(vertices[1].first, vertices[2].first);
    EXPECT_EQ(vertices[0].first, vertices[0].second);
    EXPECT_EQ(landmark_points({pairs, {}}, surface(), surface()).size(), 3u);
}

TEST_F(PairLandmarks, OfFourOnOneFaceOneIsBesideIt) {
    const auto pairs = onto_themselves(inside_one_face(4));
    ASSERT_EQ(pairs.size(), 4u);
    std::set<int> distinct;
    for (const auto& [a, b] : to_mesh_vertices(pairs, surface(), surface())) distinct.insert(a.index);
    EXPECT_EQ(distinct.size(), 4u);
}

TEST_F(PairLandmarks, AreTooNearWhereNoVertexIsFreeAround) {
    std::vector<InputVertex> all;
    for (int v = 0; v < surface().input.vertex_count(); ++v) all.push_back({v});
    EXPECT_THROW(to_mesh_vertices(onto_themselves(all), surface(), surface()), InputError);
}

TEST_F(PairLandmarks, LeaveACornerToOneThatHasNoOther) {
    const auto inside = inside_one_face(3);
    ASSERT_EQ(inside.size(), 3u);
    const int face = surface().on_mesh[std::size_t(inside[0].index)].face;
    for (int v = 0; v < surface().input.vertex_count(); ++v) {
        const SurfacePoint& at = surface().on_mesh[std::size_t(v)];
        if (at.face == face || vertex_of(surface().mesh, at) >= 0) continue;
        // One beside the face may take its corner first.
        std::vector<InputVertex> vertices{{v}};
        vertices.insert(vertices.end(), inside.begin(), inside.end());
        std::set<int> distinct;
        for (const auto& [a, b] : to_mesh_vertices(onto_themselves(vertices), surface(), surface()))
            distinct.insert(a.index);
        ASSERT_EQ(distinct.size(), vertices.size());
    }
}

/// As many landmarks as the input has vertices, of which the coarse mesh has fewer.
TEST_F(PairLandmarks, AreLeftOutWhereASketchHasNoVertexForThem) {
    SurfaceData data;
    data.surface = surface();
    data.basis.functions = RowMatrix::Ones(surface().mesh.vertex_count(), 2);
    std::vector<InputVertex> all;
    for (int v = 0; v < surface().input.vertex_count(); ++v) all.push_back({v});
    const Landmarks landmarks{onto_themselves(all), {}};
    EXPECT_THROW(pair_context(data, data, landmarks, 1), InputError);
    const PairContext context = sketch_context(data, data, landmarks, 1);
    EXPECT_LT(context.landmarks().size(), all.size());
    EXPECT_GT(context.landmarks().size(), 80u);
    EXPECT_EQ(context.landmarks_given(), int(all.size()));
    std::set<int> distinct;
    for (const auto& [a, b] : context.landmarks()) {
        EXPECT_EQ(a, b);
        distinct.insert(a.index);
    }
    EXPECT_EQ(distinct.size(), context.landmarks().size());
}

TEST_F(PairLandmarks, AtVerticesAreNoPoints) {
    const int input = vertex_of(surface().input, surface().on_input[7]);
    ASSERT_GE(input, 0);
    const auto pairs = onto_themselves({{input}});
    EXPECT_EQ(to_mesh_vertices(pairs, surface(), surface())[0].first.index, 7);
    EXPECT_TRUE(landmark_points({pairs, {}}, surface(), surface()).empty());
}

TEST(InitialMap, OntoAMirroredTargetIsOnItsFile) {
    const Surface A = preprocess(shapes::ellipsoid(2), {}), B = with_reversed_orientation(A);
    const TriangleMesh file = input_as_read(B);
    const PointMap map(std::size_t(A.input.vertex_count()), {3, {.6, .3, .1}});
    for (const auto& [vertex, image] : correspondences_of(map, A, B).from_A)
        EXPECT_LT((position(B.input, image) - position(file, map[0])).norm(), 1e-12);
}

TEST_F(PairLandmarks, MoveTheirVerticesInSpaceAndInTheBasis) {
    const auto pairs = onto_themselves(inside_one_face(2));
    SurfaceData data;
    data.surface = surface();
    data.basis.functions = RowMatrix(surface().mesh.vertex_count(), 2);
    data.basis.functions.col(0) = surface().mesh.vertices.col(0);  // linear, so known in between
    data.basis.functions.col(1).setOnes();
    const auto vertices = to_mesh_vertices(pairs, surface(), surface());
    const PairContext context = pair_context(data, data, Landmarks{pairs, {}}, 1);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const Vec3 expected = position(surface().mesh, surface().on_mesh[std::size_t(pairs[i].first.index)]);
        const int v = vertices[i].first.index;
        EXPECT_LT((context.A().surface.mesh.vertex(v) - expected).norm(), 1e-12);
        EXPECT_NEAR(context.A().basis.functions(v, 0), expected.x(), 1e-12);
        EXPECT_NEAR(context.A().basis.functions(v, 1), 1, 1e-12);
    }
    EXPECT_EQ(context.B().surface.mesh.vertex(vertices[0].second.index),
              context.A().surface.mesh.vertex(vertices[0].first.index));
}

}  // namespace
}  // namespace varimap
