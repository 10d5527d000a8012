#include "varimap/map_repair/normal_agreement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fixtures/bad_maps.h"
#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"
#include "varimap/mesh/closest_point.h"
#include "varimap/relaxation/fold_removal.h"
#include "varimap/verification/verification.h"

namespace varimap {
namespace {

/// A plate with a thin rim.
TriangleMesh plate() {
    return shapes::ellipsoid(3, {1, 1, 0.1});
}

/// The identity, but for vertices of the upper side near the rim, which slide over it to the lower side.
PointMap cut_through(const TriangleMesh& mesh) {
    const ClosestPoint closest(mesh);
    PointMap map = shapes::at_vertices(mesh);
    for (int v = 0; v < mesh.vertex_count(); v += 5) {
        const Vec3 p = mesh.vertex(v);
        if (std::hypot(p.x(), p.y()) > 0.95 && p.z() > 0)
            map[v] = closest(Vec3(0.95 * p.x(), 0.95 * p.y(), -0.05)).point;
    }
    return map;
}

using shapes::none;

int reversed_images(const SlidingMap& map) {
    int count = 0;
    for (int f = 0; f < map.source().face_count(); ++f)
        count += map.image_triangle(f).D <= FoldRemoval::flat_limit;
    return count;
}

TEST(NormalAgreement, FindsFacesThatCutThroughARim) {
    const TriangleMesh mesh = plate();
    const SlidingMap map(cut_through(mesh), mesh, mesh);
    SlidingMap copy = map;
    AlongTarget along_target(copy);
    const std::vector<int> found = NormalAgreement(copy, along_target).disagreeing_faces();
    EXPECT_FALSE(found.empty());
    EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](int f) { return map.image_triangle(f).D > 0; }))
        << "none is upright by the normals at its corners";
    const Verification judged = verify_map(map.points(), mesh, mesh);
    EXPECT_GT(judged.cutting_count + int(judged.reversed_faces.size()), int(found.size()) / 2);
}

TEST(NormalAgreement, TurnsThem) {
    const TriangleMesh mesh = plate();
    SlidingMap map(cut_through(mesh), mesh, mesh);
    AlongTarget along_target(map);
    NormalAgreement agreement(map, along_target);
    const std::size_t before = agreement.disagreeing_faces().size();
    const std::vector<int> left = agreement.improve(agreement.disagreeing_faces(), none(mesh));
    EXPECT_EQ(left, agreement.disagreeing_faces());
    EXPECT_LT(left.size(), before / 5);
    EXPECT_LT(verify_map(map.points(), mesh, mesh).reversed_faces.size(), before / 5);
}

TEST(NormalAgreement, HasNothingToDoOnAGoodMap) {
    for (const TriangleMesh& mesh : {plate(), shapes::torus(1, 0.4, 40, 16), shapes::tube(30, 16, true)}) {
        SlidingMap map(shapes::at_vertices(mesh), mesh, mesh);
        AlongTarget along_target(map);
        NormalAgreement agreement(map, along_target);
        EXPECT_TRUE(agreement.disagreeing_faces().empty());
    }
}

TEST(NormalAgreement, DoesNotAddReversedImages) {
    const TriangleMesh mesh = plate();
    for (const double noise : {0.3, 0.6}) {
        SlidingMap map(shapes::noisy_identity(mesh, noise), mesh, mesh);
        const int before = reversed_images(map);
        EXPECT_GT(before, 0);
        AlongTarget along_target(map);
        NormalAgreement agreement(map, along_target);
        agreement.improve(agreement.disagreeing_faces(), none(mesh));
        EXPECT_LE(reversed_images(map), before);
    }
}

TEST(NormalAgreement, KeepsFixedVertices) {
    const TriangleMesh mesh = plate();
    const PointMap before = cut_through(mesh);
    VertexData<bool> fixed = none(mesh);
    for (int v = 0; v < fixed.size(); v += 2) fixed[v] = 1;
    SlidingMap map(before, mesh, mesh);
    AlongTarget along_target(map);
    NormalAgreement agreement(map, along_target);
    const std::vector<int> disagreeing = agreement.disagreeing_faces();
    EXPECT_LT(agreement.improve(disagreeing, fixed).size(), disagreeing.size());
    for (int v = 0; v < fixed.size(); v += 2) {
        EXPECT_EQ(map.point(v).face, before[v].face);
        EXPECT_EQ(map.point(v).barycentric, before[v].barycentric);
    }
}

}  // namespace
}  // namespace varimap
