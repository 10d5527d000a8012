#include "stages/refine/refine.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "fixtures/known_pair.h"
#include "stages/diffuse/diffuse.h"
#include "varimap/core/error.h"

namespace varimap {
namespace {

using shapes::known_pair;
using shapes::KnownPair;

KnownPair ellipsoids() {
    const TriangleMesh rest = shapes::ellipsoid(3, {1, 1.5, 2.2});
    return known_pair(rest, shapes::shuffled(rest, 1), {}, 60, {{0, 0, 2.2}, {0, 1.5, 0}, {1, 0, 0}});
}

/// A plan of both stages has every vertex as a sample, maps landmarks exactly, and is within `bound` of the
/// truth on average, nearer than the diffusion levels leave it.
void expect_refined(const KnownPair& pair, double bound) {
    const PairContext context = pair.context();
    const Diffusion coarse = diffuse(context, {});
    const Plan plan = refine(context, coarse, {});
    const double before = mean_error(coarse, pair), after = mean_error(plan, pair);
    EXPECT_LT(after, before);
    EXPECT_LT(after, bound) << "from " << before;
    EXPECT_EQ(int(plan.plan.samples_A.size()), pair.A.surface.mesh.vertex_count());
    EXPECT_EQ(int(plan.plan.samples_B.size()), pair.B.surface.mesh.vertex_count());
    EXPECT_EQ(plan.plan.mass_A, pair.A.surface.mass);
    EXPECT_EQ(plan.record.landmarks, pair.landmarks);
    for (const auto& [a, b] : pair.landmarks) {
        EXPECT_LT((plan.centre_A.row(a.index) - pair.B.surface.mesh.vertices.row(b.index)).norm(), 1e-12);
        EXPECT_LT((plan.centre_B.row(b.index) - pair.A.surface.mesh.vertices.row(a.index)).norm(), 1e-12);
    }
}

// Bounds on mean errors are about 1.5 times what was measured; 0.02 is an edge of these meshes.

TEST(Refine, MapsAFigureOntoItsPose) {
    expect_refined(shapes::figure_pair(1, true), .015);
}  // measured .0093

TEST(Refine, MapsAnEllipsoid) {
    expect_refined(ellipsoids(), .005);
}  // measured .0027

TEST(Refine, MapsABentTubeWithOpenEnds) {
    // Hardly anything but landmarks on all its sides tells how a tube is turned about its axis.
    expect_refined(
        known_pair(shapes::tube(50, 24, false), shapes::tube(46, 26, false, .4), shapes::tube_pose(1.2), 60,
                   {{0, .45, 0}, {0, 0, .36}, {4, .29, 0}, {4, 0, .23}, {1, .35, .45}, {2, -.37, 0}}),
        .03);  // measured .018
}

TEST(Refine, GoesOnWithTheTrace) {
    const KnownPair pair = ellipsoids();
    const PairContext context = pair.context();
    const Diffusion coarse = diffuse(context, {});
    RefineParams params;
    params.levels = 1;
    const Plan plan = refine(context, coarse, params);
    ASSERT_GT(plan.trace.size(), coarse.trace.size());
    for (std::size_t i = 0; i < coarse.trace.size(); ++i)
        EXPECT_EQ(plan.trace[i].energy, coarse.trace[i].energy);
    EXPECT_EQ(plan.trace.back().level, coarse.trace.back().level + 1);
    EXPECT_EQ(plan.trace.back().euclidean, 1);
}

TEST(Refine, KeepsTheAreaBoundInBothStages) {
    // Equal ellipsoids but for their proportions: every bound is used.
    const KnownPair pair = known_pair(shapes::ellipsoid(3, {1, 1.5, 2.2}), shapes::ellipsoid(3, {1, 1, 3}),
                                      {}, 60, {{0, 0, 2.2}, {0, 1.5, 0}, {1, 0, 0}});
    const PairContext context = pair.context();
    for (const AreaEnergy energy : {AreaEnergy::transported, AreaEnergy::paper})
        for (const double bound : {1., 1.2}) {
            DiffuseParams coarse_params;
            RefineParams params;
            for (AlternationOptions* options : {&coarse_params.alternation, &params.alternation}) {
                options->area_bound = bound;
                options->area_energy = energy;
                options->mass_penalty = 0;
            }
            const Diffusion coarse = diffuse(context, coarse_params);
            for (const SamplePlan& plan : {coarse.plan, refine(context, coarse, params).plan}) {
                EXPECT_EQ(plan.area_bound, bound);
                const double D = std::sqrt(bound);
                EXPECT_LT(MassBounds::around(plan.mass_A, D).excess(plan.transported_A), 1e-3);
                EXPECT_LT(MassBounds::around(plan.mass_B, D).excess(plan.transported_B), 1e-3);
                EXPECT_NEAR((plan.transported_A.array() / plan.mass_A.array()).maxCoeff(), D, 1e-3);
                const Eigen::VectorXd rows = plan.entries * Eigen::VectorXd::Ones(plan.entries.cols());
                EXPECT_LT((rows - plan.transported_A).lpNorm<1>(), .03);
            }
        }
}

TEST(Refine, StoppedEarlyStillHasACentreForEveryVertex) {
    const KnownPair pair = ellipsoids();
    const PairContext context = pair.context();
    RefineParams params;
    params.levels = 1;
    const Plan plan = refine(context, diffuse(context, {}), params);
    EXPECT_EQ(plan.plan.samples_A, context.euclidean_level(0, 1).A.level.samples);
    EXPECT_EQ(plan.centre_A.rows(), pair.A.surface.mesh.vertex_count());
    EXPECT_EQ(plan.centre_B.rows(), pair.B.surface.mesh.vertex_count());
    EXPECT_LT(mean_error(plan, pair), .03);
}

TEST(Refine, RefusesThePlanOfOtherSurfaces) {
    const KnownPair pair = ellipsoids();
    const PairContext context = pair.context();
    DiffuseParams coarse;
    coarse.levels = 3;
    Diffusion diffusion = diffuse(context, coarse);
    diffusion.plan.samples_B.back() = diffusion.plan.samples_B.front();
    EXPECT_THROW(refine(context, diffusion, {}), ArtifactError);
}

TEST(Refine, IsTheSameToTheLastBitForAnyThreads) {
    const KnownPair pair = ellipsoids();
    const PairContext context = pair.context();
    const Diffusion coarse = diffuse(context, {});
    const auto bytes = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return encode(refine(context, coarse, {}));
    };
    EXPECT_EQ(bytes(1), bytes(2));
}

}  // namespace
}  // namespace varimap
