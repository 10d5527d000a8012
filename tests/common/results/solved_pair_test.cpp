#include "varimap/results/solved_pair.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "varimap/core/error.h"
#include "varimap/results/candidates.h"
#include "varimap/results/diffusion.h"
#include "varimap/results/plan.h"

namespace varimap {
namespace {

/// Two samples of three vertices, mapped to the one sample of two vertices.
SolvedPair small_pair() {
    SolvedPair pair;
    SamplePlan& plan = pair.plan;
    plan.samples_A = {0, 2};
    plan.samples_B = {1};
    plan.mass_A = Eigen::Vector2d(0.25, 0.75);
    plan.mass_B = Eigen::VectorXd::Ones(1);
    plan.transported_A = Eigen::Vector2d(0.3, 0.7);
    plan.transported_B = plan.mass_B;
    plan.area_bound = 1.5;
    plan.entries.resize(2, 1);
    plan.entries.insert(0, 0) = 0.25;
    plan.entries.insert(1, 0) = 0.75;
    plan.entries.makeCompressed();
    pair.trace = {{3, 1, 2, 2, 1, 17, 2.0, 1e-3, 0.5, 1e-2}};
    pair.record.landmarks = {{{2}, {1}}};
    pair.record.landmark_points = {{SurfacePoint{0, Vec3(1, 0, 0)}, SurfacePoint{4, Vec3(.25, .25, .5)}}};
    pair.record.landmark_weight = .5;
    pair.record.landmark_checks = {{.1, .2}};
    pair.record.candidates.resize(2);
    pair.record.candidate = 2;
    return pair;
}

Plan small_plan() {
    return {small_pair(), Points::Random(3, 3), Points::Random(2, 3)};
}

Diffusion small_diffusion() {
    return {small_pair(), {1, 0, 1}, {2, 0}};
}

template <class T>
void expect_refused(const T& value, const char* what) {
    T again;
    try {
        decode(encode(value), again);
        ADD_FAILURE() << "accepted inconsistent " << what;
    } catch (const ArtifactError& error) {
        EXPECT_NE(std::string(error.what()).find(std::string("inconsistent ") + what), std::string::npos)
            << error.what();
    }
}

void expect_equal(const SolvedPair& again, const SolvedPair& pair) {
    EXPECT_EQ(again.plan.samples_A, pair.plan.samples_A);
    EXPECT_EQ(again.plan.mass_A, pair.plan.mass_A);
    EXPECT_EQ(again.plan.transported_A, pair.plan.transported_A);
    EXPECT_EQ(again.plan.area_bound, 1.5);
    EXPECT_EQ(Eigen::MatrixXd(again.plan.entries), Eigen::MatrixXd(pair.plan.entries));
    EXPECT_EQ(again.record.landmarks, pair.record.landmarks);
    EXPECT_EQ(again.record.landmark_points[0].second.face, 4);
    EXPECT_EQ(again.record.landmark_weight, .5);
    EXPECT_EQ(again.record.landmark_checks[0].energy_fall, .2);
    EXPECT_EQ(again.record.candidates.size(), 2u);
    EXPECT_EQ(again.record.candidate, 2);
    ASSERT_EQ(again.trace.size(), 1u);
    EXPECT_EQ(again.trace[0].sinkhorn_iterations, 17);
    EXPECT_EQ(again.trace[0].marginal_error, 1e-2);
}

TEST(PlanArtifact, DecodesWhatItEncodes) {
    const Plan plan = small_plan();
    Plan again;
    decode(encode(plan), again);
    EXPECT_EQ(encode(again), encode(plan));
    EXPECT_EQ(again.centre_A, plan.centre_A);
    expect_equal(again, plan);
}

TEST(DiffusionArtifact, DecodesWhatItEncodes) {
    const Diffusion diffusion = small_diffusion();
    Diffusion again;
    decode(encode(diffusion), again);
    EXPECT_EQ(encode(again), encode(diffusion));
    EXPECT_EQ(again.image_vertex_A, diffusion.image_vertex_A);
    EXPECT_EQ(again.image_vertex_B, diffusion.image_vertex_B);
    expect_equal(again, diffusion);
}

TEST(SolvedPair, IsRefusedWhereItContradictsItself) {
    const double nan = std::nan("");
    const std::pair<const char*, std::function<void(SolvedPair&)>> defects[] = {
        {"numbers of samples", [](SolvedPair& p) { p.plan.samples_A.push_back(1); }},
        {"samples", [](SolvedPair& p) { p.plan.samples_A[1] = 3; }},
        {"samples", [](SolvedPair& p) { p.plan.samples_A[1] = 0; }},
        {"samples", [](SolvedPair& p) { p.plan.samples_B[0] = -1; }},
        {"masses", [](SolvedPair& p) { p.plan.mass_B = Eigen::VectorXd::Ones(2); }},
        {"masses", [](SolvedPair& p) { p.plan.mass_A = Eigen::Vector2d(-.25, 1.25); }},
        {"masses", [](SolvedPair& p) { p.plan.mass_A = Eigen::Vector2d(.25, .25); }},
        {"transported masses", [](SolvedPair& p) { p.plan.transported_A.resize(3); }},
        {"transported masses", [=](SolvedPair& p) { p.plan.transported_A[0] = nan; }},
        {"area bound", [](SolvedPair& p) { p.plan.area_bound = .5; }},
        {"entries", [](SolvedPair& p) { p.plan.entries.setZero(); }},
        {"entries", [=](SolvedPair& p) { p.plan.entries.coeffRef(0, 0) = nan; }},
        {"entries", [](SolvedPair& p) { p.plan.entries.coeffRef(0, 0) = -1; }},
        {"trace", [](SolvedPair& p) { p.trace.clear(); }},
        {"trace", [](SolvedPair& p) { p.trace[0].level = -1; }},
        {"trace", [=](SolvedPair& p) { p.trace[0].energy = nan; }},
        {"landmarks",
         [](SolvedPair& p) {
             p.record.landmarks = {{{0}, {2}}};
         }},
        {"landmarks", [](SolvedPair& p) { p.record.landmark_points.resize(2); }},
        {"landmarks", [](SolvedPair& p) { p.record.landmark_points[0].first.face = -1; }},
        {"landmarks", [](SolvedPair& p) { p.record.landmark_points[0].first.barycentric *= 2; }},
        {"landmark weight", [](SolvedPair& p) { p.record.landmark_weight = 0; }},
        {"landmark checks", [](SolvedPair& p) { p.record.landmark_checks.resize(2); }},
        {"candidates", [](SolvedPair& p) { p.record.candidate = 3; }},
    };
    for (const auto& [what, damage] : defects) {
        Plan plan = small_plan();
        damage(plan);
        expect_refused(plan, what);
        Diffusion diffusion = small_diffusion();
        damage(diffusion);
        expect_refused(diffusion, what);
    }
}

TEST(SolvedPair, IsRefusedWithImagesThatCannotBe) {
    Plan plan = small_plan();
    plan.centre_B(1, 2) = std::nan("");
    expect_refused(plan, "centres");
    Diffusion diffusion = small_diffusion();
    diffusion.image_vertex_A[0] = 2;  // the other mesh has two vertices
    expect_refused(diffusion, "image vertices");
}

Candidates small_candidates() {
    const SurfacePoint point{0, Vec3(.25, .75, 0)};
    Candidates candidates;
    candidates.list.resize(1);
    candidates.maps = {{{{point, point}}, {{point, point}}}};
    candidates.previews = {{point}};
    candidates.telling = {2, {5}};
    return candidates;
}

TEST(CandidatesArtifact, IsRefusedWhereItContradictsItself) {
    Candidates again;
    EXPECT_NO_THROW(decode(encode(small_candidates()), again));
    const std::pair<const char*, std::function<void(Candidates&)>> defects[] = {
        {"numbers of maps", [](Candidates& c) { c.list.clear(); }},
        {"numbers", [](Candidates& c) { c.list[0].score = std::nan(""); }},
        {"numbers", [](Candidates& c) { c.list[0].self_map_B = -1; }},
        {"maps", [](Candidates& c) { c.maps[0].from_A.clear(); }},
        {"maps", [](Candidates& c) { c.maps[0].from_B[0].second.face = -1; }},
        {"maps", [](Candidates& c) { c.maps[0].from_A[0].first.barycentric *= 2; }},
        {"previews", [](Candidates& c) { c.previews.resize(2); }},
        {"the vertex that tells", [](Candidates& c) { c.telling.images.push_back(1); }},
        {"the vertex that tells", [](Candidates& c) { c.telling.images[0] = -1; }},
        {"the vertex that tells", [](Candidates& c) { c.telling.source = -1; }},
        {"previews", [](Candidates& c) { c.previews[0][0].barycentric[0] = std::nan(""); }},
    };
    for (const auto& [what, damage] : defects) {
        Candidates candidates = small_candidates();
        damage(candidates);
        expect_refused(candidates, what);
    }
}

TEST(CandidatesArtifact, IsRefusedForSurfacesWithFewerFaces) {
    TriangleMesh one, none;
    one.faces.resize(1, 3);
    none.faces.resize(0, 3);
    EXPECT_NO_THROW(require_surfaces(small_candidates(), one, one));
    EXPECT_THROW(require_surfaces(small_candidates(), one, none), ArtifactError);
}

}  // namespace
}  // namespace varimap
