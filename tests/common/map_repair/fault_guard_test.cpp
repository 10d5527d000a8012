#include "varimap/map_repair/fault_guard.h"

#include <gtest/gtest.h>

#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"
#include "varimap/core/index_set.h"

namespace varimap {
namespace {

class Guarded : public testing::Test {
  protected:
    const TriangleMesh ball_ = shapes::ellipsoid(3);
    const PointMap given_ = shapes::at_vertices(ball_);
    const std::vector<int> all_ = all_indices(ball_.vertex_count());
    SlidingMap map_{given_, ball_, ball_};
    FaultJudges judges_{map_};

    bool is_moved(int v) const { return (position(ball_, map_.point(v)) - ball_.vertex(v)).norm() > 1e-9; }
    /// A little, which turns no face over.
    void nudge(int v) { map_.place(v, map_.walk(map_.point(v), 0.1 * map_.longest_edge(v) * askew(v))); }
    /// Beyond its neighbours.
    void fold(int v) { map_.place(v, map_.walk(map_.point(v), 1.7 * map_.longest_edge(v) * askew(v))); }
    int reversed() {
        AlongTarget along_target(map_);
        int count = 0;
        for (int f = 0; f < ball_.face_count(); ++f) count += along_target.is_reversed(f);
        return count;
    }

  private:
    Vec3 askew(int v) const { return map_.tangents(v) * Eigen::Vector2d(0.6, 0.8); }
};

TEST_F(Guarded, PutsBackWhatFoldsAndKeepsTheRest) {
    constexpr int here = 0, far_away = 300;
    FaultGuard guard(map_, judges_);
    guard(all_, [&] {
        fold(here);
        nudge(far_away);
    });
    EXPECT_FALSE(is_moved(here));
    EXPECT_TRUE(is_moved(far_away));
    EXPECT_EQ(reversed(), 0);
}

TEST_F(Guarded, LetsFaultsFromBeforeBe) {
    constexpr int here = 0;
    fold(here);
    const int before = reversed();
    ASSERT_GT(before, 0);
    const Vec3 folded = map_.image(here);
    FaultGuard guard(map_, judges_);
    guard(all_, [&] { nudge(here); });
    EXPECT_GT((map_.image(here) - folded).norm(), 1e-9);
    EXPECT_LE(reversed(), before);
}

TEST_F(Guarded, MovesOnlyWhatIsFreeBack) {
    FaultGuard guard(map_, judges_);
    guard({5}, [&] { fold(5); });
    EXPECT_FALSE(is_moved(5));
    for (const int v : all_) EXPECT_FALSE(is_moved(v));
}

}  // namespace
}  // namespace varimap
