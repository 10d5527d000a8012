#include "varimap/untangling/fault_repair.h"

#include <gtest/gtest.h>

#include "fixtures/bad_maps.h"
#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"

namespace varimap {
namespace {

/// A map that has a leg crushed to its root, upright.
class MissedLeg : public testing::Test {
  protected:
    TriangleMesh rest = shapes::figure(0.15), posed = shapes::figure_pose(0.5)(rest);
    VertexData<bool> fixed{rest.vertex_count()};
    SlidingMap map{
        shapes::with_leg(
            rest, [](const Vec3& p) -> Vec3 { return shapes::leg_origin + .05 * (p - shapes::leg_origin); }),
        rest, posed};
    const std::vector<SoftConstraint> landmarks;
    UntanglingOptions options;
    UntanglingReport report;

    MissedLeg() { options.repair_again = false; }  // as on coarse meshes
    void recover() {
        FaultRepair repair(map, fixed, landmarks, nullptr, options, report);
        repair.recover(shapes::at_vertices(rest));
    }
};

TEST_F(MissedLeg, IsTakenFromTheOtherDirection) {
    recover();
    EXPECT_LT(shapes::mean_error(map.points(), posed, shapes::on_leg(rest)), shapes::longest_edge(posed));
}

TEST_F(MissedLeg, StaysWhereManyMoreFaultsComeOfIt) {
    constexpr int many = 24;  // with what is around them
    // Some faces of its lower part stay as they are, and are reversed.
    const std::vector<char> leg = shapes::on_leg(rest);
    int reversed = 0;
    for (int f = 0; f < rest.face_count() && reversed < many; ++f) {
        const auto corners = rest.faces.row(f);
        if (!leg[std::size_t(corners[0])] || !(rest.vertices(corners[0], 2) < -.7)) continue;
        const SurfacePoint first = map.point(corners[0]);
        map.place(corners[0], map.point(corners[1]));
        map.place(corners[1], first);
        mark_corners(rest, f, fixed);
        ++reversed;
    }
    ASSERT_EQ(reversed, many);
    const PointMap before = map.points();
    recover();
    for (std::size_t v = 0; v < before.size(); ++v) {
        ASSERT_EQ(map.point(int(v)).face, before[v].face);
        ASSERT_EQ(map.point(int(v)).barycentric, before[v].barycentric);
    }
    EXPECT_EQ(report.sweeps, 0);
    EXPECT_EQ(report.disagreeing_before, 0);
    EXPECT_EQ(report.disagreeing_after, 0);
}

TEST(FaultRepair, TakesATangleFromTheOtherDirection) {
    const TriangleMesh mesh = shapes::figure(0.15);
    SlidingMap map{shapes::crumpled_leg(mesh), mesh, mesh};
    const std::vector<char> leg = shapes::on_leg(mesh);
    VertexData<bool> fixed(mesh.vertex_count());
    for (int v = 0; v < fixed.size(); ++v) fixed[v] = leg[std::size_t(v)];
    const std::vector<SoftConstraint> landmarks;
    const UntanglingOptions options;
    UntanglingReport report;
    FaultRepair repair(map, fixed, landmarks, nullptr, options, report);
    repair(shapes::at_vertices(mesh));  // in vain: all that is faulty is held
    ASSERT_GT(repair.faults().value(), 10);
    fixed = VertexData<bool>(mesh.vertex_count());
    repair.adopt(shapes::at_vertices(mesh));
    EXPECT_EQ(repair.faults(), 0);
    EXPECT_LT(shapes::mean_error(map.points(), mesh, shapes::on_leg(mesh)), shapes::longest_edge(mesh));
}

}  // namespace
}  // namespace varimap
