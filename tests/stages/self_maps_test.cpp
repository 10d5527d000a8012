#include "stages/explore/self_maps.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "fixtures/explored.h"
#include "fixtures/known_pair.h"
#include "stages/explore/finishing.h"
#include "stages/explore/pool.h"

namespace varimap {
namespace {

using shapes::figures;
using shapes::finish_from;
using shapes::KnownPair;

/// A person without face or feet, whose front is its back: turning it about is nearly a self-map.
TriangleMesh turnable() {
    return shapes::ellipsoid(3, {.6, 1, 2});
}

TEST(SelfMaps, AreTheTurnsOfAnEllipsoid) {
    const TriangleMesh mesh = turnable();
    const KnownPair pair = shapes::known_pair(mesh, mesh, {}, 60, {});
    const PairContext context(pair.A, pair.A, {});
    const Candidates found = find_self_maps(context, ExploreParams());
    ASSERT_GE(found.list.size(), 1u);
    for (std::size_t k = 0; k < found.list.size(); ++k) {
        EXPECT_FALSE(is_mirrored(found.list[k]));
        EXPECT_GT(found.list[k].turn, 140);  // twisted a little: they are rough
        EXPECT_LT(found.list[k].score, .2);  // log of the energy, less the identity's
        EXPECT_EQ(int(found.maps[k].from_A.size()), pair.A.surface.mesh.vertex_count());
    }
}

TEST(SelfMaps, BringTheRightMapToAWrongOne) {
    const TriangleMesh mesh = turnable();
    const KnownPair pair = shapes::known_pair(mesh, mesh, {}, 60, {});
    const PairContext context(pair.A, pair.A, {});
    const Surface& surface = context.A().surface;
    const std::vector<VertexImages> turns = images_of(find_self_maps(context, ExploreParams()), surface);
    ASSERT_FALSE(turns.empty());
    std::vector<PooledMap> pool{{turns[0], {.explored = 1}}};
    compose(pool, 1, turns, {}, context);
    std::vector<VertexImages> starts;
    for (const PooledMap& map : pool) starts.push_back(map.images);
    FinishingOptions options;
    options.gap = options.gap_at_first = 1000;
    double least = 1;
    const Points& truth = surface.mesh.vertices;
    for (const FinishedMap& map : finish_from(context, starts, options))
        least = std::min(least, shapes::mean_error(map.maps.A_to_B, surface.mesh, truth));
    EXPECT_LT(least, .05);  // one of them is a half turn done twice: the identity
    starts.resize(1);
    EXPECT_GT(shapes::mean_error(finish_from(context, starts, options)[0].maps.A_to_B, surface.mesh, truth),
              .2);
}

/// Counts how often self-maps of either surface are asked for.
struct AskedFor {
    int A = 0, B = 0;
    SelfMapsOnDemand ask{[this] { return ++A, Candidates(); }, [this] { return ++B, Candidates(); }};
};

TEST(SelfMaps, AreThoseOfOneSurfaceWhereShapesAreAlike) {
    const KnownPair alike = shapes::figure_pair(.5, false, 1000);
    AskedFor asked;
    OnDemand ask;
    ask.self_maps = asked.ask;
    ExploreParams params;
    params.exploration.candidates = 1;  // no rival that is turned about
    params.exploration.coarse = 1;
    explore({alike.A, alike.B, {}}, params, ask);
    EXPECT_EQ(asked.A, 0);
    EXPECT_EQ(asked.B, 1);
}

TEST(SelfMaps, AreAskedForOnceAndWhereTheyAreNeeded) {
    const PairContext context = figures().context();
    AskedFor asked;
    LazySelfMaps self_maps(context, asked.ask);
    std::vector<PooledMap> pool;
    self_maps.add_compositions_with_B(pool, 2);
    EXPECT_EQ(asked.A, 0);
    EXPECT_EQ(asked.B, 1);
    self_maps.add_compositions(pool, 2);
    self_maps.add_compositions(pool, 2);
    EXPECT_EQ(asked.A, 1);
    EXPECT_EQ(asked.B, 1);
}

}  // namespace
}  // namespace varimap
