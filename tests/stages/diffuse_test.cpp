#include "stages/diffuse/diffuse.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <numeric>

#include "fixtures/known_pair.h"
#include "fixtures/surface_data.h"
#include "stages/diffuse/check_landmarks.h"
#include "varimap/core/error.h"
#include "varimap/core/logged.h"
#include "varimap/mesh/topology.h"
#include "varimap/pair_stage/pair_inputs.h"
#include "varimap/surface/input_locator.h"

namespace varimap {
namespace {

using shapes::known_pair;
using shapes::KnownPair;

KnownPair ellipsoids(const std::vector<Vec3>& landmarks) {
    const TriangleMesh rest = shapes::ellipsoid(3, {1, 1.5, 2.2});
    return known_pair(rest, shapes::shuffled(rest, 1), {}, 60, landmarks);
}

KnownPair ellipsoids_with_landmarks() {
    return ellipsoids({{0, 0, 2.2}, {0, 1.5, 0}, {1, 0, 0}});
}

// Bounds on mean errors are about 1.5 times what was measured; 0.02 is an edge of these meshes.

TEST(Diffuse, MapsAFigureOntoItsPoseWithoutLandmarks) {
    const KnownPair figures = shapes::figure_pair(1, false);
    EXPECT_LT(mean_error(diffuse(figures.context(), {}), figures), .025);  // measured .0157
}

TEST(Diffuse, GivesAPlanOfTheLastLevel) {
    const KnownPair pair = ellipsoids_with_landmarks();
    const PairContext context = pair.context();
    DiffuseParams params;
    params.alternation.area_bound = 1;  // exact marginals
    const Diffusion found = diffuse(context, params);
    const SamplePlan& plan = found.plan;
    EXPECT_LT(mean_error(found, pair), .02);  // measured .0134
    const LevelPair last = context.diffusion_level(context.diffusion_levels() - 1);
    EXPECT_EQ(plan.samples_A, last.A.level.samples);
    EXPECT_EQ(plan.samples_B, last.B.level.samples);
    EXPECT_EQ(plan.mass_A, last.A.level.mass);
    EXPECT_EQ(found.record.landmarks, pair.landmarks);
    const Eigen::VectorXd rows = plan.entries * Eigen::VectorXd::Ones(plan.entries.cols());
    EXPECT_LT((rows - plan.mass_A).lpNorm<1>(), .02);
    EXPECT_NEAR(plan.entries.sum(), 1, .01);
    ASSERT_EQ(int(found.image_vertex_A.size()), pair.A.surface.mesh.vertex_count());
    ASSERT_EQ(int(found.image_vertex_B.size()), pair.B.surface.mesh.vertex_count());
}

TEST(Diffuse, TracesEveryAlternation) {
    const KnownPair pair = ellipsoids_with_landmarks();
    const Diffusion found = diffuse(pair.context(), {});
    ASSERT_FALSE(found.trace.empty());
    for (std::size_t i = 0; i < found.trace.size(); ++i) {
        const TraceRow& row = found.trace[i];
        const bool new_level = i == 0 || row.level != found.trace[i - 1].level;
        EXPECT_EQ(row.level, i == 0 ? 0 : found.trace[i - 1].level + new_level);
        EXPECT_EQ(row.iteration, new_level ? 0 : found.trace[i - 1].iteration + 1);
        EXPECT_EQ(row.euclidean, 0);
        EXPECT_GT(row.energy, 0);
        EXPECT_GT(row.gamma, 0);
        EXPECT_LE(row.marginal_error, .011);
        EXPECT_LE(row.entries, double(row.samples_A) * row.samples_B);
    }
    EXPECT_EQ(found.trace.back().samples_A, int(found.plan.samples_A.size()));
}

TEST(Diffuse, StopsAfterTheLevelsAskedFor) {
    const KnownPair pair = ellipsoids_with_landmarks();
    const PairContext context = pair.context();
    DiffuseParams params;
    params.levels = 3;
    const Diffusion found = diffuse(context, params);
    EXPECT_EQ(found.trace.back().level, 2);
    EXPECT_EQ(found.plan.samples_A, context.diffusion_level(2).A.level.samples);
}

TEST(Diffuse, TellsSymmetriesOfAlignedSurfacesApartByWassersteinDistance) {
    // An ellipsoid has three mirror planes: nothing but position tells its eight octants apart.
    const KnownPair pair = ellipsoids({});
    DiffuseParams params;
    EXPECT_GT(mean_error(diffuse(pair.context(), params), pair), .1);
    params.start = FirstCentres::wasserstein;
    params.wasserstein_weight = .1;
    EXPECT_LT(mean_error(diffuse(pair.context(), params), pair), .02);  // measured .0141
}

TEST(Diffuse, IsTheSameToTheLastBitForAnyThreads) {
    const KnownPair pair = ellipsoids_with_landmarks();
    const auto bytes = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return encode(diffuse(pair.context(), {}));
    };
    EXPECT_EQ(bytes(1), bytes(2));
}

TEST(Diffuse, IgnoresTheSignsOfEigenfunctions) {
    KnownPair pair = ellipsoids_with_landmarks();
    DiffuseParams params;
    params.levels = 6;
    const Diffusion before = diffuse(pair.context(), params);
    for (int k = 1; k < pair.B.basis.functions.cols(); k += 2) pair.B.basis.functions.col(k) *= -1;
    const Diffusion after = diffuse(pair.context(), params);
    EXPECT_EQ(before.plan.samples_B, after.plan.samples_B);
    EXPECT_LT((before.plan.entries - after.plan.entries).norm(), 1e-9 * before.plan.entries.norm());
}

TEST(Diffuse, DoesNotDependOnPlaceAndScaleNorOnTheOrderOfVertices) {
    const KnownPair pair = ellipsoids_with_landmarks();
    const auto energy_with = [&](const TriangleMesh& other, const std::vector<int>& old_vertex) {
        KnownPair changed = pair;
        changed.B = shapes::surface_data(shapes::unit_surface(other), 60);
        for (auto& [a, b] : changed.landmarks)
            b.index = int(std::find(old_vertex.begin(), old_vertex.end(), b.index) - old_vertex.begin());
        return diffuse(changed.context(), {}).trace.back().energy;
    };
    const TriangleMesh& B = pair.B.surface.mesh;
    std::vector<int> old_vertex, same(std::size_t(B.vertex_count()));
    std::iota(same.begin(), same.end(), 0);
    const double plain = energy_with(B, same);
    EXPECT_NEAR(energy_with(shapes::moved(B, 30, 1, {4, 5, 6}), same), plain, .01 * plain);
    const TriangleMesh shuffled = shapes::shuffled(B, 9, &old_vertex);
    EXPECT_NEAR(energy_with(shuffled, old_vertex), plain, .03 * plain);
}

/// The landmark at the left hind foot, put beside the left forefoot.
void move_landmark(KnownPair& pair) {
    const TriangleMesh& B = pair.B.surface.mesh;
    pair.landmarks[2].second = {
        shapes::nearest_vertex(B, B.vertex(pair.landmarks[0].second.index) + Vec3(.05, 0, 0))};
    ASSERT_NE(pair.landmarks[2].second, pair.landmarks[0].second);
}

TEST(Diffuse, OverrulesASoftLandmarkThatIsFarOff) {
    KnownPair pair = shapes::figure_pair(1, true);
    move_landmark(pair);
    const auto error_at_landmark = [&](const Diffusion& found) {
        const std::size_t v = std::size_t(pair.landmarks[2].first.index);
        const SurfacePoint image = read_out(found, pair.A.surface, pair.B.surface).A_to_B[v];
        return (position(pair.B.surface.mesh, image) - Vec3(pair.A_on_B.row(Eigen::Index(v)))).norm();
    };
    EXPECT_GT(error_at_landmark(diffuse(pair.context(), {})), .4);
    const Diffusion soft = diffuse(pair.context(.1), {});
    EXPECT_LT(error_at_landmark(soft), .05);
    EXPECT_EQ(soft.record.landmark_weight, .1);
    EXPECT_FALSE(soft.record.pins_landmarks());
    EXPECT_LT(mean_error(soft, pair), .025);
    EXPECT_EQ(contradicted_landmark(soft.record.landmark_checks), 2);
}

TEST(Diffuse, NamesTheLandmarkThatTheOthersContradict) {
    KnownPair pair = shapes::figure_pair(1, true);
    const AlternationOptions options = DiffuseParams().alternation;
    EXPECT_EQ(contradicted_landmark(check_landmarks(pair.context(), options)), -1);
    move_landmark(pair);
    const auto checks = check_landmarks(pair.context(), options);
    ASSERT_EQ(checks.size(), 4u);
    EXPECT_EQ(contradicted_landmark(checks), 2);
    EXPECT_GT(checks[2].distance, .5);
    EXPECT_GT(checks[2].energy_fall, checks[1].energy_fall);
}

TEST(Diffuse, SaysWhereSourceAndTargetLookExchangedInLandmarks) {
    const KnownPair pair = shapes::figure_pair(1, true);
    const auto in_input = [](const Surface& surface, MeshVertex v) {
        return InputVertex{shapes::nearest_vertex(
            surface.input, surface.mesh.vertex(v.index) / surface.scale + surface.centre)};
    };
    Landmarks right, exchanged;
    for (const auto& [on_A, on_B] : pair.landmarks) {
        const InputVertex a = in_input(pair.A.surface, on_A), b = in_input(pair.B.surface, on_B);
        right.vertices.emplace_back(a, b);
        exchanged.vertices.emplace_back(b, a);
    }
    const auto warnings_of = [&](const Landmarks& landmarks) {
        const std::size_t before = logged_warnings().size();
        warn_of_exchanged_columns(landmarks, pair_context(pair.A, pair.B, landmarks, 1));
        return logged_warnings().size() - before;
    };
    EXPECT_EQ(warnings_of(right), 0u);
    EXPECT_EQ(warnings_of(exchanged), 1u);
    EXPECT_NE(logged_warnings().back().find("source and target look exchanged"), std::string::npos);
}

TEST(Diffuse, ChecksNoMoreLandmarksThanTimeAllows) {
    KnownPair pair = ellipsoids_with_landmarks();
    pair.landmarks.clear();
    for (int v = 0; v < 101; ++v) pair.landmarks.emplace_back(MeshVertex{v}, MeshVertex{v});
    EXPECT_TRUE(check_landmarks(pair.context(), DiffuseParams().alternation).empty());
}

/// Every vertex with that of the other mesh nearest to where it belongs, all moved by `shift` vertices.
Correspondences true_map(const KnownPair& pair, int shift) {
    const auto pairs = [&](const TriangleMesh& from, const TriangleMesh& to, const Points& truth) {
        const PointMap points = points_at_vertices(from), images = points_at_vertices(to);
        PointPairs result;
        for (int v = 0; v < from.vertex_count(); v += 3) {
            const int image = shapes::nearest_vertex(to, truth.row(v).transpose());
            result.emplace_back(points[std::size_t(v)],
                                images[std::size_t((image + shift) % to.vertex_count())]);
        }
        return result;
    };
    const TriangleMesh &A = pair.A.surface.input, &B = pair.B.surface.input;
    return {pairs(A, B, pair.A_on_B), pairs(B, A, pair.B_on_A)};
}

TEST(Diffuse, ContinuesTheCandidateAskedFor) {
    KnownPair pair = shapes::figure_pair(1, false);
    for (SurfaceData* side : {&pair.A, &pair.B})  // coordinates of meshes and inputs agree
        side->surface.input = normalised_input(side->surface);
    const PairContext context = pair.context();
    Candidates candidates;
    candidates.list.resize(2);
    candidates.maps = {true_map(pair, 700), true_map(pair, 0)};
    DiffuseParams params;
    params.candidate = 2;
    const Diffusion found = diffuse(context, params, candidates);
    EXPECT_EQ(found.record.candidate, 2);
    EXPECT_EQ(found.record.candidates.size(), 2u);
    EXPECT_GT(found.trace.front().level, 0);
    EXPECT_LT(mean_error(found, pair), .025);
    params.candidate = 1;
    EXPECT_GT(mean_error(diffuse(context, params, candidates), pair), .1);
    params.candidate = 3;
    EXPECT_THROW(diffuse(context, params, candidates), UsageError);
}

}  // namespace
}  // namespace varimap
