#include "varimap/parts/continuation.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "fixtures/bad_maps.h"
#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"

namespace varimap {
namespace {

/// Marks the vertices where `inside` holds.
template <class Inside>
VertexData<bool> marks(const TriangleMesh& mesh, const Inside& inside) {
    VertexData<bool> open(mesh.vertex_count());
    for (int v = 0; v < mesh.vertex_count(); ++v) open[v] = inside(mesh.vertex(v));
    return open;
}

/// The identity with the images of the open vertices on the target's first face.
PointMap damaged_identity(const TriangleMesh& mesh, const VertexData<bool>& open) {
    PointMap map = shapes::at_vertices(mesh);
    for (int v = 0; v < int(map.size()); ++v)
        if (open[v]) map[v] = {0, Vec3::Constant(1. / 3)};
    return map;
}

PointMap continued(const TriangleMesh& source, const TriangleMesh& target, const VertexData<bool>& open,
                   double scale = 1) {
    SlidingMap map(damaged_identity(source, open), source, target);
    continue_map(map, open, scale);
    return map.points();
}

void expect_identity_continued(const TriangleMesh& source, const TriangleMesh& target,
                               const VertexData<bool>& open) {
    const PointMap map = continued(source, target, open), truth = shapes::at_vertices(target);
    EXPECT_LT(shapes::mean_error(map, target, open), 0.1 * shapes::longest_edge(target));
    for (int v = 0; v < int(map.size()); ++v)
        if (!open[v]) {
            EXPECT_EQ(map[v].barycentric, truth[v].barycentric) << "given image moved";
        }
}

TEST(Continuation, ClosesACapOfASphere) {
    const TriangleMesh sphere = shapes::ellipsoid(3);
    expect_identity_continued(sphere, sphere, marks(sphere, [](const Vec3& p) { return p.z() > 0.4; }));
}

TEST(Continuation, ClosesAGapOfATorusFromBothSides) {
    const TriangleMesh torus = shapes::torus(1, 0.4, 40, 16);
    expect_identity_continued(torus, torus, marks(torus, [](const Vec3& p) { return p.x() > 0.5; }));
}

TEST(Continuation, FollowsALimbOfAnotherPose) {
    const TriangleMesh rest = shapes::figure(0.15);
    expect_identity_continued(rest, shapes::figure_pose(0.5)(rest), shapes::on_leg(rest));
}

TEST(Continuation, KeepsTheScaleOfTheTarget) {
    const TriangleMesh sphere = shapes::ellipsoid(3);
    const VertexData<bool> open = marks(sphere, [](const Vec3& p) { return p.z() > 0.4; });
    expect_identity_continued(sphere, shapes::moved(sphere, 7, 0.4, {1, 2, 3}), open);
}

TEST(Continuation, ReachesAsFarAsTheScaleSays) {
    const TriangleMesh tube = shapes::tube(60, 24, true);
    const VertexData<bool> open = marks(tube, [](const Vec3& p) { return p.x() < 2; });
    const auto end = [&](double scale) { return position(tube, continued(tube, tube, open, scale)[0]).x(); };
    EXPECT_NEAR(end(1), tube.vertex(0).x(), 0.05);
    EXPECT_NEAR(end(0.85), 2 - 0.85 * (2 - tube.vertex(0).x()), 0.15);
    EXPECT_NEAR(end(0.7), 2 - 0.7 * (2 - tube.vertex(0).x()), 0.3);
}

TEST(Continuation, KeepsWhatNoFrontReaches) {
    const TriangleMesh one = shapes::ellipsoid(2), far = shapes::moved(one, 1, 0, {9, 0, 0});
    TriangleMesh both{Points(2 * one.vertices.rows(), 3), Faces(2 * one.faces.rows(), 3)};
    both.vertices << one.vertices, far.vertices;
    both.faces << one.faces, far.faces.array() + one.vertex_count();
    const VertexData<bool> open = marks(both, [](const Vec3& p) { return p.x() > 5 || p.z() > 0.5; });
    const PointMap before = damaged_identity(both, open), after = continued(both, both, open);
    for (int v = 0; v < both.vertex_count(); ++v) {
        const SurfacePoint &was = before[v], &is = after[v];
        const bool kept = is.face == was.face && is.barycentric == was.barycentric;
        EXPECT_EQ(kept, v >= one.vertex_count() || !open[v]);
    }
}

TEST(Continuation, GivesNoImageToAVertexThatHadNone) {
    const TriangleMesh sphere = shapes::ellipsoid(3);
    VertexData<bool> open = marks(sphere, [](const Vec3& p) { return p.z() > 0.4; });
    PointMap without = damaged_identity(sphere, open);
    const int hole = int(std::find(open.begin(), open.end(), 1) - open.begin());
    without[hole].face = -1;
    SlidingMap map(without, sphere, sphere);
    continue_map(map, open, 1);
    EXPECT_FALSE(map.has_image(hole));
    open[hole] = 0;
    EXPECT_LT(shapes::mean_error(map.points(), sphere, open), 0.1 * shapes::longest_edge(sphere));
}

TEST(Continuation, DoesNotDependOnTheImagesItReplaces) {
    const TriangleMesh torus = shapes::torus(1, 0.4, 40, 16);
    const VertexData<bool> open = marks(torus, [](const Vec3& p) { return p.x() > 0.5; });
    SlidingMap from_identity(shapes::at_vertices(torus), torus, torus);
    continue_map(from_identity, open, 1);
    const PointMap from_damage = continued(torus, torus, open);
    for (int v = 0; v < open.size(); ++v) {
        EXPECT_EQ(from_damage[v].face, from_identity.point(v).face);
        EXPECT_EQ(from_damage[v].barycentric, from_identity.point(v).barycentric);
    }
}

}  // namespace
}  // namespace varimap
