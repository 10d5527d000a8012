#include "stages/coarsen/coarsen.h"

#include <gtest/gtest.h>

#include "fixtures/mesh_vertex.h"
#include "fixtures/shapes.h"
#include "stages/preprocess/preprocess.h"
#include "varimap/core/error.h"
#include "varimap/mesh/topology.h"
#include "varimap/surface/input_locator.h"

namespace varimap {
namespace {

/// Another size, and elsewhere, so that coordinates of mesh and input cannot be taken for each other.
TriangleMesh input() {
    TriangleMesh mesh = shapes::figure(.12);
    mesh.vertices *= 7;
    mesh.vertices.rowwise() += Eigen::RowVector3d(100, -20, 3);
    return mesh;
}

CoarsenParams to(int vertices) {
    CoarsenParams params;
    params.vertices = vertices;
    params.most_lost = 1;
    return params;
}

TEST(CoarsenStage, BringsTheSurfaceToItsResolution) {
    const Surface fine = preprocess(input(), {}), surface = coarsened(fine, to(1000));
    EXPECT_EQ(surface.mesh.vertex_count(), 1000);
    EXPECT_EQ(surface.input.vertices, fine.input.vertices);
    EXPECT_NEAR(surface_area(surface.mesh), 1, 1e-12);
    EXPECT_NEAR(surface.mass.sum(), 1, 1e-12);
    Surface copy;
    EXPECT_NO_THROW(decode(encode(surface), copy));
}

TEST(CoarsenStage, KnowsTheWayBothWays) {
    const Surface surface = coarsened(preprocess(input(), {}), to(1000));
    const double size = 1 / surface.scale, edge = .03 * size;
    const InputLocator locate(surface);
    double farthest = 0;
    for (int v = 0; v < surface.input.vertex_count(); ++v) {
        const SurfacePoint& at = surface.on_mesh[std::size_t(v)];
        ASSERT_GE(at.face, 0);
        farthest = std::max(farthest, (position(surface.input, locate(at)) - surface.input.vertex(v)).norm());
    }
    EXPECT_LT(farthest, edge);
    int known = 0;
    for (int v = 0; v < surface.mesh.vertex_count(); ++v) {
        const int input_vertex = vertex_of(surface.input, surface.on_input[std::size_t(v)]);
        if (input_vertex < 0) continue;  // in the middle of an edge that was bisected
        EXPECT_EQ(shapes::mesh_vertex_at(surface, {input_vertex}).index, v);
        ++known;
    }
    EXPECT_GT(known, 500);
}

TEST(CoarsenStage, LeavesASmallSurfaceAsItIs) {
    const Surface fine = preprocess(input(), {});
    EXPECT_EQ(encode(coarsened(fine, to(100'000))), encode(fine));
}

TEST(CoarsenStage, CoarsensWhatWasCoarsened) {
    const Surface coarse = coarsened(preprocess(input(), {}), to(1000)), sketch = coarsened(coarse, to(500));
    EXPECT_EQ(sketch.mesh.vertex_count(), 500);
    EXPECT_EQ(sketch.input.vertices, coarse.input.vertices);
    // An input vertex lies where it did, but for what the mesh lost: less than its edges' length, .06.
    const double size = 1 / sketch.scale;
    for (int v = 0; v < sketch.input.vertex_count(); ++v) {
        const Vec3 x = (sketch.input.vertex(v) - sketch.centre) * sketch.scale;
        EXPECT_LT((position(sketch.mesh, sketch.on_mesh[std::size_t(v)]) - x).norm(), .06) << size;
    }
    for (int v = 0; v < 500; ++v)
        EXPECT_LT((position(sketch.input, sketch.on_input[std::size_t(v)]) * sketch.scale -
                   sketch.centre * sketch.scale - sketch.mesh.vertex(v))
                      .norm(),
                  1e-9);
}

TEST(CoarsenStage, ServesMirroredSurfaces) {
    PreprocessParams params;
    params.mirror = true;
    const Surface surface = coarsened(preprocess(input(), params), to(1000));
    const InputLocator locate(surface);
    for (int v = 0; v < surface.input.vertex_count(); v += 10)
        EXPECT_LT((position(surface.input, locate(surface.on_mesh[std::size_t(v)])) - surface.input.vertex(v))
                      .norm(),
                  .03 / surface.scale);
}

}  // namespace
}  // namespace varimap
