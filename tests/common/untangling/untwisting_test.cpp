#include "varimap/untangling/untwisting.h"

#include <gtest/gtest.h>

#include "fixtures/twisted_shaft.h"
#include "varimap/quality/quality.h"

namespace varimap {
namespace {

/// Mean distance of images from where they began, in units of the length 2.
double off(const PointMap& map, const TriangleMesh& mesh) {
    double sum = 0;
    for (int v = 0; v < mesh.vertex_count(); ++v)
        sum += (position(mesh, map[std::size_t(v)]) - mesh.vertex(v)).norm();
    return sum / mesh.vertex_count();
}

class UntwistedShaft : public testing::TestWithParam<double> {};

TEST_P(UntwistedShaft, IsNearItself) {
    const TriangleMesh shaft = shapes::shaft();
    const MapPair twisted{shapes::twisted_shaft(shaft, GetParam()),
                          shapes::twisted_shaft(shaft, -GetParam())};
    const VertexData<bool> none(shaft.vertex_count());
    MapPair left = twisted, taken = twisted;
    untangle(left, shaft, shaft, {none, none}, {});
    EXPECT_GT(measure_twist(left.A_to_B, shaft, shaft).degrees, 120) << "untangling alone leaves it";
    untangle_untwisted(taken, shaft, shaft, {none, none}, {});
    EXPECT_LT(measure_twist(taken.A_to_B, shaft, shaft).degrees, 40);
    EXPECT_LT(measure_twist(taken.B_to_A, shaft, shaft).degrees, 40);
    EXPECT_LT(off(taken.A_to_B, shaft), .4 * off(left.A_to_B, shaft));
    EXPECT_LT(off(taken.B_to_A, shaft), .4 * off(left.B_to_A, shaft));
}
INSTANTIATE_TEST_SUITE_P(Turns, UntwistedShaft, testing::Values(180., 300., 360.));

/// A map that is not twisted is that of untangle.
TEST(Untwisted, LeavesOtherMapsAsTheyAre) {
    const TriangleMesh shaft = shapes::shaft();
    const PointMap turned = shapes::twisted_shaft(shaft, 20);
    const VertexData<bool> none(shaft.vertex_count());
    MapPair maps{turned, turned}, same{turned, turned};
    untangle(maps, shaft, shaft, {none, none}, {});
    untangle_untwisted(same, shaft, shaft, {none, none}, {});
    for (std::size_t v = 0; v < turned.size(); ++v) {
        ASSERT_EQ(maps.A_to_B[v].face, same.A_to_B[v].face);
        ASSERT_EQ(maps.A_to_B[v].barycentric, same.A_to_B[v].barycentric);
    }
}

TEST(Untwisting, IsByTheTurnsButFullOnesLeaveTheEnds) {
    const TriangleMesh shaft = shapes::shaft();
    const auto turn_of_ends = [&](double degrees) {
        const auto found = untwisting(shapes::twisted_shaft(shaft, degrees), shaft, shaft, 0);
        EXPECT_TRUE(found.has_value());
        int first = 0, last = 0;
        shaft.vertices.col(0).minCoeff(&first);
        shaft.vertices.col(0).maxCoeff(&last);
        return std::abs(found->turn[std::size_t(last)] - found->turn[std::size_t(first)]) * 180 /
               std::numbers::pi;
    };
    EXPECT_NEAR(turn_of_ends(120), 120, 20);
    EXPECT_NEAR(turn_of_ends(330), 360, 1);
}

}  // namespace
}  // namespace varimap
