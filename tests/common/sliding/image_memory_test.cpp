#include "varimap/sliding/image_memory.h"

#include <gtest/gtest.h>

#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"

namespace varimap {
namespace {

TEST(FaceMemory, JudgesAFaceAgainOnlyWhereACornersImageMoved) {
    const TriangleMesh mesh = shapes::ellipsoid(2, {1, 1, 1});
    SlidingMap map(shapes::at_vertices(mesh), mesh, mesh);
    FaceMemory<bool> memory(map);
    int judged = 0;
    const auto is_even = [&](int f) { return ++judged, f % 2 == 0; };
    for (int round = 0; round < 2; ++round)
        for (int f = 0; f < mesh.face_count(); ++f) EXPECT_EQ(memory(f, is_even), f % 2 == 0);
    EXPECT_EQ(judged, mesh.face_count());

    const int v = mesh.faces(7, 0);
    const SurfacePoint start = map.point(v);
    map.move(v, 0.01 * map.tangents(v).col(0));
    for (int f = 0; f < mesh.face_count(); ++f) memory(f, is_even);
    const int around = int(map.faces_of_vertex()[v].size());
    EXPECT_EQ(judged, mesh.face_count() + around) << "faces without that corner";

    map.place(v, start);
    EXPECT_FALSE(memory(7, is_even));
    EXPECT_EQ(judged, mesh.face_count() + around + 1);
}

}  // namespace
}  // namespace varimap
