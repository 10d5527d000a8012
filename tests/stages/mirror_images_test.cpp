#include "stages/explore/mirror_images.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "fixtures/explored.h"
#include "fixtures/known_pair.h"
#include "fixtures/surface_data.h"
#include "stages/explore/finishing.h"
#include "stages/explore/landmark_spread.h"
#include "stages/explore/pool.h"
#include "stages/explore/self_maps.h"
#include "stages/preprocess/preprocess.h"
#include "varimap/core/logged.h"
#include "varimap/results/choice.h"

namespace varimap {
namespace {

using shapes::finish_from;
using shapes::KnownPair;
using shapes::person;
using shapes::reflected;

/// Explored without landmarks, as a pair of files is.
Candidate best_of(const KnownPair& pair) {
    const PairContext context = pair.context();
    const ExploreParams params;
    OnDemand ask;
    ask.self_maps = find_when_asked(context, params);
    return explore(context, params, ask).list.front();
}

TEST(MirrorImages, TellALeftOneFromARightOne) {
    const KnownPair same = shapes::figure_pair(.5, false, 1000);
    EXPECT_FALSE(fits_mirrored(best_of(same)));
    const Candidate opposite = best_of(reflected(same));
    EXPECT_TRUE(fits_mirrored(opposite));
    EXPECT_FALSE(confidence_of({opposite}).confident);
    EXPECT_THAT(doubt({opposite}), testing::HasSubstr("fit better as mirror images"));
}

/// Which it fits better, and which is no wonder.
TEST(MirrorImages, OfOneSurfaceRaiseNoDoubtOfItsReflection) {
    KnownPair own = person();
    own.B = own.A;
    EXPECT_FALSE(is_own_mirror_image(PairContext(own.A, own.B, {})));
    own.B.surface = with_reversed_orientation(own.A.surface);
    EXPECT_TRUE(is_own_mirror_image(PairContext(own.A, own.B, {})));
    EXPECT_FALSE(fits_mirrored(best_of(own)));
    EXPECT_FALSE(is_own_mirror_image(PairContext(own.A, reflected(person()).B, {})));
}

/// Landmarks that decide, and keep all from being looked for, know a left one, too.
TEST(MirrorImages, AreToldFromByLandmarks) {
    const KnownPair same = shapes::figure_pair(.2, true, 1000), other = reflected(same);
    ExploreParams params;
    params.only_if_needed = true;
    const PairContext right = same.context(), left = other.context();
    ASSERT_GE(right.landmarks().size(), 4u);
    EXPECT_FALSE(landmarks_look_mirrored(right, false));
    EXPECT_TRUE(landmarks_look_mirrored(left, false));
    EXPECT_FALSE(landmarks_look_mirrored(left, true)) << "with --mirror";
    EXPECT_FALSE(fits_mirrored(explore(right, params).list.front()));
    EXPECT_TRUE(fits_mirrored(explore(left, params).list.front()));
    params.few_landmarks = 3;
    const std::size_t before = logged_warnings().size();
    EXPECT_TRUE(explore(right, params).list.empty());
    EXPECT_EQ(logged_warnings().size(), before);
    EXPECT_TRUE(explore(left, params).list.empty());
    ASSERT_EQ(logged_warnings().size(), before + 1);
    EXPECT_THAT(logged_warnings().back(), testing::HasSubstr("--mirror"));
}

TEST(MirrorImages, AreTheSameOnCoarseLevels) {
    const KnownPair pair = shapes::figure_pair(.5, false, 1000);
    const PairContext context(pair.A, pair.B, {});
    const ExploreParams params;
    const ExplorationProgress coarse = coarsely_explored(context, params.exploration, params),
                              mirror =
                                  coarsely_explored(with_mirror_image(context), params.exploration, params);
    EXPECT_GT(coarse.levels, 3);
    EXPECT_LT(coarse.levels, context.diffusion_levels());
    ASSERT_EQ(coarse.levels, mirror.levels);
    ASSERT_EQ(coarse.pool.size(), mirror.pool.size());
    for (std::size_t n = 0; n < coarse.pool.size(); ++n)
        EXPECT_EQ(coarse.pool[n].energy(), mirror.pool[n].energy());
}

MirrorImages of_pair(const PairContext& context, const ExploreParams& params,
                     const FinishingOptions& finishing) {
    return {context, coarsely_explored(context, params.exploration, params), params, finishing, 10};
}

TEST(MirrorImages, OfBodiesThatAreTheirOwnLeadToMapsAsTheyAre) {
    const KnownPair pair = person();
    const PairContext context(pair.A, pair.B, {});
    FinishingOptions options;
    options.gap = options.gap_at_first = 1000;
    const ExploreParams params;
    const MirrorImages mirror = of_pair(context, params, options);
    EXPECT_LT(mirror.best().score, -30);
    std::vector<VertexImages> starts;
    for (const PooledMap& map : mirror.mirrored_back().maps) {
        EXPECT_TRUE(map.origin.mirrored_back);
        starts.push_back(map.images);
    }
    double least = 1;
    for (const FinishedMap& map : finish_from(context, starts, options))
        least = std::min(least, shapes::mean_error(map.maps, pair));
    EXPECT_LT(least, .05);
}

TEST(MirrorImages, TellBodiesThatAreTheirOwnFromALeftAndARightOne) {
    const ExploreParams params;
    const SurfaceData body = person().A;
    TriangleMesh with_long_legs = body.surface.mesh;
    for (int v = 0; v < with_long_legs.vertex_count(); ++v)
        if (double& z = with_long_legs.vertices(v, 2); z < 0) z *= 1.5;
    const PairContext unlike(body, shapes::surface_data(preprocess(with_long_legs, {}), 60), {});
    EXPECT_TRUE(of_pair(unlike, params, params.quick_finishing()).mirrored_back().are_their_own);
    const KnownPair pair = reflected(shapes::figure_pair(.5, false, 1000));
    const PairContext context(pair.A, pair.B, {});
    EXPECT_FALSE(of_pair(context, params, params.quick_finishing()).mirrored_back().are_their_own);
}

}  // namespace
}  // namespace varimap
