#include "common/mapping/normal_agreement.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/bad_maps.h"
#include "common/map_shapes.h"
#include "common/mapping/fold_removal.h"
#include "common/mapping/verification.h"
#include "common/mesh/closest_point.h"
#include "common/shapes.h"

namespace varimap {
namespace {

/// A plate with a thin rim.
TriangleMesh plate() { return shapes::ellipsoid(4, {1, 1, 0.1}); }

/// The identity, but what lies on the upper side beyond x = 0.75 is slid over the rim to the lower side.
PointMap cut_through(const TriangleMesh& mesh) {
    const ClosestPoint closest(mesh);
    PointMap map = shapes::at_vertices(mesh);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const Vec3 p = mesh.vertex(v);
        if (p.x() > 0.9 && p.z() > -0.02) map[std::size_t(v)] = closest(Vec3(p.x() - .1, p.y(), -p.z() - .03)).point;
    }
    return map;
}

int reversed_chords(const MovingMap& map) {
    int count = 0;
    for (int f = 0; f < map.source().face_count(); ++f) count += map.chord(f).D <= FoldRemoval::flat_limit;
    return count;
}

TEST(NormalAgreement, X) {
    const TriangleMesh mesh = plate();
    MovingMap map(cut_through(mesh), mesh, mesh);
    NormalAgreement agreement(map);
    std::printf("%d reversed %d disagree %d verify\n", reversed_chords(map), int(agreement.disagreeing_faces().size()), int(verify_map(map.points(), mesh, mesh).reversed_faces.size()));
    for (const int f : agreement.disagreeing_faces()) std::printf(" %d:%g", f, map.chord(f).D);
    int m = agreement.improve(std::vector<char>(std::size_t(mesh.vertex_count()), 0));
    std::printf("moves %d %d reversed %d disagree\n", m, reversed_chords(map), int(agreement.disagreeing_faces().size()));
}

}  // namespace
}  // namespace varimap
