#include "stages/remesh/remesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <string>

#include "fixtures/mesh_vertex.h"
#include "fixtures/sphere_pair.h"
#include "stages/remesh/quality_json.h"
#include "stages/remesh/warnings.h"
#include "varimap/core/error.h"
#include "varimap/core/logged.h"
#include "varimap/quality/quality.h"

namespace varimap {
namespace {

using Json = nlohmann::json;

class Remesh : public ::testing::Test {
  protected:
    shapes::SpherePair pair_;

    /// As the stage tells of it, warnings included.
    Json quality(const SurfaceMap& map, const PointMap& initial_map = {}) const {
        const MapQuality found = measure_quality(map, pair_.A, pair_.B, pair_.plan, initial_map);
        warn_of(found, pair_.plan.record);
        return Json::parse(quality_json(found, map, pair_.A, pair_.B, pair_.plan));
    }
    /// Of the map as the plan has it.
    Json quality() const { return quality(pair_.as_planned()); }
    /// Those of that map which hold some words.
    std::vector<std::string> warnings(const std::string& words) const {
        const std::size_t before = logged_warnings().size();
        quality();
        std::vector<std::string> found;
        for (std::size_t i = before; i < logged_warnings().size(); ++i)
            if (logged_warnings()[i].find(words) != std::string::npos) found.push_back(logged_warnings()[i]);
        return found;
    }
    /// Pairs landmarks of `rows`, of the same number on both spheres, but from one row on with the next
    /// one's.
    void shift_landmarks(const std::vector<int>& rows, std::size_t from) {
        pair_.plan.record.landmarks.clear();
        for (std::size_t k = 0; k < rows.size(); ++k) {
            const std::size_t next = k + 1 < rows.size() ? k + 1 : from;
            pair_.plan.record.landmarks.push_back({{rows[k]}, {rows[k < from ? k : next]}});
        }
    }
};

/// The corners of the icosahedron that the spheres are made of, no two in a row adjacent.
const std::vector<int> far_corners{0, 3, 1, 2, 5, 6, 4, 7, 11, 9, 10, 8};

TEST_F(Remesh, SaysWhichSoftLandmarksAreFarFromMet) {
    pair_.plan.record.landmark_weight = .2;
    pair_.plan.record.landmarks = {{{far_corners[0]}, {far_corners[0]}}};
    EXPECT_TRUE(warnings("far from met").empty());
    pair_.plan.record.landmarks.push_back({{far_corners[1]}, {far_corners[2]}});
    EXPECT_THAT(warnings("far from met"),
                testing::ElementsAre(testing::HasSubstr("landmark 2, soft, is far from met")));
}

TEST_F(Remesh, CrossRemeshingMovesTheSourceOntoTheTarget) {
    pair_.A.input.space = Space::lps;
    pair_.B.input.space = Space::ras;
    const TriangleMesh moved = cross_remesh(pair_.as_planned().A_to_B, pair_.A, pair_.B);
    EXPECT_EQ(moved.faces, pair_.A.input.faces);
    EXPECT_EQ(moved.space, Space::ras) << "it lies where the target lies";
    EXPECT_LT((moved.vertices - pair_.B.input.vertices).norm(), 1e-12)
        << "the spare vertex keeps its relative place";
}

TEST_F(Remesh, TellsHowFarLandmarksAreFromTheirPartners) {
    pair_.plan.record.landmarks = {{{5}, {9}}};  // a wrong one
    Json numbers = quality();
    EXPECT_NEAR(numbers["landmarks"][0], 0, 1e-12);
    EXPECT_EQ(numbers["landmark_weight"], 1);
    pair_.plan.record.landmark_weight = .5;
    numbers = quality();
    EXPECT_EQ(numbers["landmark_weight"], .5);
    EXPECT_GT(numbers["landmarks"][0], .01);
}

void expect_finite_numbers(const Json& json, const std::string& where) {
    if (json.is_structured())
        for (const auto& [key, value] : json.items()) expect_finite_numbers(value, where + "/" + key);
    else
        EXPECT_TRUE(json.is_number() ? std::isfinite(json.get<double>()) : json.is_string()) << where;
}

TEST_F(Remesh, QualityHasTheDocumentedKeys) {
    const Json numbers = quality();
    expect_finite_numbers(numbers, "");
    EXPECT_EQ(numbers["energy"], 0.25);
    EXPECT_EQ(numbers["area_bound"], 1);
    for (const char* side : {"source", "target"})
        for (const char* end : {"min", "max"}) EXPECT_EQ(numbers["mass_ratio"][side][end], 1);
    ASSERT_EQ(numbers["landmarks"].size(), 1u);
    EXPECT_NEAR(numbers["landmarks"][0], 0, 1e-12);
    for (const char* direction : {"source_to_target", "target_to_source"}) {
        const Json& each = numbers[direction];
        EXPECT_EQ(each["flipped_count"], 0);
        EXPECT_EQ(each["flipped_area_percent"], 0);
        EXPECT_NEAR(each["dirichlet_energy"], 1, 1e-9);
        EXPECT_NEAR(each["coverage"], 1, 1e-9);
        EXPECT_EQ(each["untangling"]["flipped_before"], 0);
        EXPECT_EQ(each["untangling"]["flipped_after"], 0);
        EXPECT_EQ(each["untangling"]["mirrored_parts"], 0);
        EXPECT_EQ(each["verification"]["reversed_count"], 0);
        EXPECT_EQ(each["verification"]["reversed_area_percent"], 0);
        EXPECT_EQ(each["verification"]["branch_points"], 0);
        EXPECT_NEAR(each["verification"]["signed_area_ratio"], 1, 1e-9);
        EXPECT_EQ(each["verification"]["degree"], 1);
        for (const char* name : {"area_ratio", "conformal_distortion"})
            for (const char* share : {"p01", "p05", "p50", "p95", "p99"})
                EXPECT_NEAR(each[name][share], 1, 1e-9);
    }
    EXPECT_NEAR(numbers["round_trip"]["mean"], 0, 1e-12);
    EXPECT_NEAR(numbers["round_trip"]["p95"], 0, 1e-12);
    EXPECT_EQ(numbers["source"]["input_vertices"], pair_.A.input.vertex_count());
    EXPECT_EQ(numbers["target"]["input_faces"], pair_.B.input.face_count());
    EXPECT_EQ(numbers["source"]["vertices"], pair_.A.mesh.vertex_count());
}

/// Without the faces around a vertex of A, and the images there.
TEST_F(Remesh, DoesNotBlameAMapForWhatAHoleLacks) {
    SurfaceMap map = pair_.as_planned();
    const Json whole = quality(map);
    EXPECT_FALSE(whole["source_to_target"].contains("when_closed"));
    Faces& faces = pair_.A.input.faces;
    const Eigen::VectorXd height = pair_.A.input.vertices(faces.reshaped(), 2);
    const auto top = [&](int f) {
        const double z = pair_.A.input.vertices(faces.row(f), 2).mean();
        return z > .05 * height.minCoeff() + .95 * height.maxCoeff();
    };
    std::vector<int> kept, number(std::size_t(faces.rows()), -1);
    for (int f = 0; f < int(faces.rows()); ++f)
        if (!top(f)) number[std::size_t(f)] = int(kept.size()), kept.push_back(f);
    faces = Faces(faces(kept, Eigen::all));
    for (SurfacePoint& image : map.B_to_A)
        if (image.face >= 0) image.face = number[std::size_t(image.face)];
    const Json cut = quality(map);
    const Json& there = cut["source_to_target"];
    EXPECT_LT(there["coverage"], .98);
    EXPECT_GT(there["when_closed"]["coverage"], .99);
    EXPECT_FALSE(there["uncovered"].empty());
    EXPECT_TRUE(there["when_closed"]["uncovered"].empty());
    EXPECT_FALSE(cut["target_to_source"].contains("when_closed"));
}

/// A sphere that lacks its upper third is a part.
TEST_F(Remesh, BlamesAMapForWhatAPartLacks) {
    const SurfaceMap map = pair_.as_planned();
    Faces& faces = pair_.A.input.faces;
    const Eigen::VectorXd height = pair_.A.input.vertices(faces.reshaped(), 2);
    const double limit = (height.minCoeff() + 2 * height.maxCoeff()) / 3;
    std::vector<int> kept;
    for (int f = 0; f < int(faces.rows()); ++f)
        if (pair_.A.input.vertices(faces.row(f), 2).mean() < limit) kept.push_back(f);
    faces = Faces(faces(kept, Eigen::all));
    pair_.plan.record.landmarks.clear();  // they lie on faces by their numbers of before
    SurfaceMap one_way = map;
    for (SurfacePoint& image : one_way.B_to_A) image.face = -1;
    const Json there = quality(one_way)["source_to_target"];
    EXPECT_LT(there["coverage"], .9);
    EXPECT_FALSE(there.contains("when_closed"));
}

TEST_F(Remesh, DoubtsAMapOfASurfaceThatIsInsideOut) {
    pair_.plan.record.candidates = {Candidate{.dirichlet = 1, .relief = .9, .score = -30}};
    pair_.plan.record.candidate = 1;
    const SurfaceMap map = pair_.as_planned();
    const double sure = quality(map)["exploration"]["probability"];
    pair_.A.mesh.faces.col(1).swap(pair_.A.mesh.faces.col(2));
    EXPECT_NEAR(quality(map)["exploration"]["probability"], sure / 2, 1e-6);
}

TEST_F(Remesh, IsLessSureOfAMapThatIsStrainedInTheEnd) {
    pair_.plan.record.candidates = {Candidate{.dirichlet = 1, .relief = .9, .score = -30}};
    pair_.plan.record.candidate = 1;
    EXPECT_TRUE(quality()["exploration"]["confident"]);
    SurfaceMap strained = pair_.as_planned();
    std::rotate(strained.A_to_B.begin(), strained.A_to_B.begin() + 7, strained.A_to_B.end());
    Json exploration = quality(strained)["exploration"];
    EXPECT_FALSE(exploration["confident"]);
    EXPECT_TRUE(exploration["confident_when_found"]);
    EXPECT_NE(std::string(exploration["doubt"]).find("finished, it is strained"), std::string::npos);
    pair_.plan.record.candidate = 2;  // the map says nothing of the first
    exploration = quality(strained)["exploration"];
    EXPECT_TRUE(exploration["confident"]);
    EXPECT_EQ(exploration["doubt"], "");
}

TEST_F(Remesh, TellsTransportedMassesOfInputVertices) {
    pair_.plan.plan.transported_A[3] = 1.25 * pair_.plan.plan.mass_A[3];
    EXPECT_NEAR(double(quality()["mass_ratio"]["source"]["max"]), 1.25, 1e-12);
    std::istringstream lines(masses_csv(pair_.A, pair_.plan.plan.samples_A, pair_.plan.plan.transported_A,
                                        pair_.plan.plan.mass_A));
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "vertex,ratio");
    int count = 0;
    while (std::getline(lines, line)) {
        const int vertex = std::stoi(line);
        EXPECT_EQ(line, std::to_string(vertex) +
                            (shapes::mesh_vertex_at(pair_.A, {vertex}).index == 3 ? ",1.25" : ",1"));
        ++count;
    }
    EXPECT_EQ(count, pair_.A.mesh.vertex_count());  // not the spare vertex
}

TEST_F(Remesh, QualityHoldsWhatUntanglingReported) {
    SurfaceMap map = pair_.as_planned();
    map.untangling.B_to_A.flipped_before = 7;
    map.untangling.B_to_A.gated_area_percent = 2.5;
    const Json numbers = quality(map)["target_to_source"]["untangling"];
    EXPECT_EQ(numbers["flipped_before"], 7);
    EXPECT_EQ(numbers["gated_area_percent"], 2.5);
    EXPECT_EQ(numbers["flipped_after"], 0);
}

TEST_F(Remesh, QualitySumsUpTheLevels) {
    const Json levels = quality()["levels"];
    ASSERT_EQ(levels.size(), 2u);
    EXPECT_EQ(levels[0]["kind"], "diffusion");
    EXPECT_EQ(levels[0]["iterations"], 2);
    EXPECT_EQ(levels[0]["energy"], 0.8);
    EXPECT_EQ(levels[0]["samples_target"], 12);
    EXPECT_EQ(levels[1]["kind"], "euclidean");
    EXPECT_EQ(levels[1]["iterations"], 1);
}

TEST_F(Remesh, QualityHoldsFiniteNumbersOnly) {
    pair_.plan.trace.back().energy = std::nan("");
    pair_.plan.trace.front().energy = std::numeric_limits<double>::infinity();
    const Json numbers = quality();
    expect_finite_numbers(numbers, "");
    EXPECT_FALSE(numbers.contains("energy"));
}

TEST_F(Remesh, CollapsedMapsHaveFiniteQuality) {
    pair_.plan.centre_A.setZero();
    pair_.make_incomplete();
    const Json numbers = quality();
    expect_finite_numbers(numbers, "");
    EXPECT_GT(numbers["source_to_target"]["flipped_area_percent"], 90);
}

/// A ball drawn out to a spindle: nothing is reversed or left out.
TEST_F(Remesh, StrainedMapsAreSaid) {
    EXPECT_TRUE(warnings("the map is strained").empty());
    pair_.B.input.vertices.col(2) *= 8;
    const auto strained = warnings("the map is strained");
    ASSERT_EQ(strained.size(), 1u);
    EXPECT_NE(strained[0].find("a part of the other"), std::string::npos);
    EXPECT_EQ(strained[0].find("slivers"), std::string::npos);
}

TEST_F(Remesh, SliversAreNamedAsWhatStrainsAMap) {
    pair_.B.input.vertices.col(2) *= 100;
    const auto strained = warnings("the map is strained");
    ASSERT_EQ(strained.size(), 1u);
    EXPECT_NE(strained[0].find("the area of the target lies on slivers"), std::string::npos) << strained[0];
    EXPECT_EQ(strained[0].find("a part of the other"), std::string::npos);
    pair_.A.input.vertices.col(2) *= 100;
    EXPECT_TRUE(warnings("slivers").empty()) << "a map that is not strained needs no cause";
}

TEST_F(Remesh, ExchangedLandmarksThatLieNearAreSaid) {
    const TriangleMesh& mesh = pair_.A.mesh;
    const Vec3 between = (mesh.vertex(0) + mesh.vertex(1)) / 2;  // two edges from both
    Eigen::Index nearest;
    (mesh.vertices.rowwise() - between.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
    const int near = int(nearest);
    pair_.plan.record.landmarks = {{{3}, {3}}, {{0}, {0}}, {{near}, {near}}};
    EXPECT_TRUE(warnings("landmark").empty());
    pair_.plan.record.landmarks = {{{3}, {3}}, {{0}, {near}}, {{near}, {0}}};
    for (const LandmarkSurroundings& around : landmark_surroundings(
             pair_.as_planned().A_to_B, landmarks_on_inputs(pair_.plan.record, pair_.A, pair_.B),
             pair_.A.input, pair_.B.input))
        EXPECT_LT(around.distance, 4 * around.radius) << "not elsewhere";
    const auto said = warnings("landmark");
    ASSERT_EQ(said.size(), 1u);
    EXPECT_NE(
        said[0].find("landmarks 2 and 3 look exchanged: each one's surroundings go to the other's partner"),
        std::string::npos)
        << said[0];
}

TEST_F(Remesh, ExchangedLandmarksThatLieFarAreSaidOnce) {
    pair_.plan.record.landmarks = {{{0}, {3}}, {{1}, {2}}, {{3}, {0}}, {{2}, {1}}};
    EXPECT_EQ(warnings("landmarks 1 with 3 and 2 with 4 look exchanged").size(), 1u);
    EXPECT_TRUE(warnings("the map is elsewhere").empty());
    EXPECT_TRUE(warnings("one row off").empty());
}

TEST_F(Remesh, WarningsOfLandmarksAreJoined) {
    shift_landmarks(far_corners, far_corners.size());
    EXPECT_TRUE(warnings("landmark").empty());
    shift_landmarks(far_corners, 4);
    EXPECT_EQ(warnings("the map is elsewhere").size(), 1u);
    EXPECT_EQ(warnings("around landmarks 5, 6, 7, 8, 9, 10, 11 and 12 the map is elsewhere").size(), 1u);
    EXPECT_EQ(warnings("all landmarks from 5 on, to the last one, are off: is the list one row off?").size(),
              1u);
    shift_landmarks(far_corners, 0);
    EXPECT_EQ(warnings("around landmarks 1, 2, 3, 4, 5, 6, 7, 8, 9, 10 and 2 more the map").size(), 1u);
}

TEST_F(Remesh, FewLandmarksThatAreOffAreNoShift) {
    shift_landmarks(far_corners, 9);
    EXPECT_EQ(warnings("around landmarks 10 and 11 the map").size(), 1u);
    EXPECT_TRUE(warnings("one row off").empty());
    shift_landmarks(far_corners, 4);
    pair_.plan.record.landmarks.push_back({{20}, {20}});  // the last one is right
    EXPECT_TRUE(warnings("one row off").empty());
    pair_.plan.record.landmarks = {{{0}, {0}}, {{5}, {2}}};
    EXPECT_EQ(warnings("around landmark 2 the map is elsewhere: it is met alone").size(), 1u);
}

/// One landmark missed, a choice that is sure no more, and a tear in either direction.
MapQuality doubtful_quality() {
    MapQuality quality;
    quality.A_to_B.coverage.share = quality.B_to_A.coverage.share = 1;
    quality.A_to_B.verification.reversed_area_percent = 5;
    quality.A_to_B.verification.reversed_faces = {0, 1, 2, 3, 4};
    quality.B_to_A.coverage.share = .5;
    quality.in_the_end.dirichlet = 2;
    quality.landmarks = {{.5}, {LandmarkSurroundings{}}, {}};
    quality.choice = ChoiceQuality{{.confident = true}, {.confident = false}, "finished, it is strained"};
    quality.median_thinness_A = quality.median_thinness_B = .5;
    return quality;
}

std::vector<std::string> said_of(const MapQuality& quality, const PairRecord& record) {
    const std::size_t before = logged_warnings().size();
    warn_of(quality, record);
    const std::vector<std::string> all = logged_warnings();
    return {all.begin() + std::ptrdiff_t(before), all.end()};
}

TEST(RemeshWarnings, AreOfATwistByTheDirectionThatHasMore) {
    MapQuality quality;
    quality.A_to_B.coverage.share = quality.B_to_A.coverage.share = 1;
    quality.median_thinness_A = quality.median_thinness_B = .5;
    quality.A_to_B.twist = {50, 3, .4};
    EXPECT_TRUE(said_of(quality, {}).empty());
    quality.B_to_A.twist = {309, 12, .5};
    const auto said = said_of(quality, {});
    ASSERT_EQ(said.size(), 1u);
    EXPECT_NE(
        said[0].find("twists the target around vertex 12 (50% of its area) by 309 degrees from end to end"),
        std::string::npos);
}

TEST(RemeshWarnings, AreOfLandmarksMostOfWhichAreMetAlone) {
    MapQuality quality;
    quality.A_to_B.coverage.share = quality.B_to_A.coverage.share = 1;
    quality.median_thinness_A = quality.median_thinness_B = .5;
    const LandmarkSurroundings met{.distance = .01, .radius = .02}, alone{.distance = .04, .radius = .02};
    quality.landmarks = {{0, 0, 0, 0, 0, 0}, {alone, met, alone, met, met, alone}, {}};
    EXPECT_TRUE(said_of(quality, {}).empty()) << "half of them";
    quality.landmarks.surroundings[3] = alone;
    const auto said = said_of(quality, {});
    ASSERT_EQ(said.size(), 1u);
    EXPECT_NE(
        said[0].find("most landmarks are met alone: around landmarks 1, 3, 4 and 6 the map is off by up "
                     "to 0.04 sqrt(area)"),
        std::string::npos);
}

TEST_F(Remesh, TellsHowFarTheMapIsFromTheInitialOne) {
    const SurfaceMap map = pair_.as_planned();
    EXPECT_FALSE(quality().contains("initial_map"));
    const Json same = quality(map, map.A_to_B)["initial_map"];
    for (const char* key : {"mean", "p50", "p95"}) EXPECT_NEAR(same[key], 0, 1e-12);
    PointMap constant = map.A_to_B;
    for (SurfacePoint& image : constant)
        if (image.face >= 0) image = map.A_to_B[1];
    const Json other = quality(map, constant)["initial_map"];
    EXPECT_NEAR(other["mean"], 4. / 3 / std::sqrt(4 * std::numbers::pi), .02) << "of chords from one point";
    EXPECT_EQ(other["step"], 0);
    EXPECT_GT(same["step"], 0);
}

TEST(RemeshWarnings, AreOfAnInitialMapThatWasFineAndIsLeft) {
    MapQuality quality;
    quality.A_to_B.coverage.share = quality.B_to_A.coverage.share = 1;
    quality.median_thinness_A = quality.median_thinness_B = .5;
    quality.initial_map = InitialMapQuality{.mean = .07, .p50 = .066, .p95 = .14, .step = .02};
    EXPECT_THAT(said_of(quality, {}),
                testing::ElementsAre(testing::HasSubstr("far from the initial one: 0.070 sqrt(area)")));
    quality.initial_map->step = .07;
    EXPECT_TRUE(said_of(quality, {}).empty()) << "it was coarse";
    quality.initial_map = InitialMapQuality{.mean = .056, .p50 = .014, .p95 = .4, .step = .02};
    EXPECT_TRUE(said_of(quality, {}).empty()) << "single images were wrong";
}

TEST(RemeshWarnings, AreOfComponentsWithoutAPartner) {
    MapQuality quality;
    quality.A_to_B.coverage.share = quality.B_to_A.coverage.share = 1;
    quality.median_thinness_A = quality.median_thinness_B = .5;
    quality.components.of_source = {{0, .9, 0, 1, 1}, {70, .1, 0, 1, .1}};
    quality.components.of_target = {{0, 1, 0, 1, 1}};
    auto said = said_of(quality, {});
    ASSERT_EQ(said.size(), 1u);
    EXPECT_NE(said[0].find("of the source that of vertex 70 (10% of the area). What the other surface lacks"),
              std::string::npos);
    quality.components.of_target.push_back({5, .003, -1, 0, 0});
    said = said_of(quality, {});
    ASSERT_EQ(said.size(), 1u);
    EXPECT_NE(said[0].find("vertex 70 (10% of the area) and of the target that of vertex 5 (0.3% of the area)"
                           ". Give landmarks on those that belong together"),
              std::string::npos);
}

TEST(RemeshWarnings, AreOfLandmarksThenOfTheChoiceThenOfTears) {
    PairRecord record;
    record.candidates.resize(2);
    const auto said = said_of(doubtful_quality(), record);
    ASSERT_EQ(said.size(), 4u);
    EXPECT_NE(said[0].find("landmark 1 is not met"), std::string::npos);
    EXPECT_NE(said[1].find("less sure than its candidate was (finished, it is strained): look at the "
                           "picture, try --candidate 2, or give landmarks"),
              std::string::npos);
    EXPECT_NE(said[2].find("source to target: the map tears: 5.0% of the area is reversed. Is"),
              std::string::npos);
    EXPECT_NE(said[3].find("target to source: the map tears: only 50.0% of the other surface is covered. Is"),
              std::string::npos);
}

TEST(RemeshWarnings, OfTearsAreNotOfAFewLargeFaces) {
    MapQuality quality = doubtful_quality();
    quality.A_to_B.verification.reversed_faces = {0};
    quality.B_to_A.coverage.share = 1;
    EXPECT_THAT(said_of(quality, {}), testing::Each(testing::Not(testing::HasSubstr("tears"))));
}

TEST(RemeshWarnings, AskForMoreLandmarksWhereThereAreSome) {
    PairRecord record;
    record.candidates.resize(2);
    EXPECT_THAT(said_of(doubtful_quality(), record),
                testing::Each(testing::Not(testing::HasSubstr("more landmarks"))));
    record.landmarks = {{MeshVertex{0}, MeshVertex{0}}};
    const auto said = said_of(doubtful_quality(), record);
    EXPECT_THAT(said[1], testing::HasSubstr("try --candidate 2, or give more landmarks"));
    EXPECT_THAT(said[2], testing::HasSubstr("Look at the picture, give more landmarks"));
}

TEST(RemeshWarnings, SayStrainWhereNothingTearsAndNothingOfSoftLandmarksThatAreALittleOff) {
    MapQuality quality = doubtful_quality();
    for (double& residual : quality.landmarks.residuals) residual = std::min(residual, .19);
    quality.choice.reset();
    quality.A_to_B.verification.reversed_area_percent = 0;
    quality.B_to_A.coverage.share = 1;
    PairRecord record;
    record.landmark_weight = .5;
    const auto said = said_of(quality, record);
    ASSERT_EQ(said.size(), 1u);
    EXPECT_NE(said[0].find("a Dirichlet energy of 2.00"), std::string::npos);
}

TEST_F(Remesh, ServesMirroredSurfaces) {
    const TriangleMesh file = pair_.mirror_A();
    const SurfaceMap map = pair_.as_planned();
    const Json numbers = quality(map);
    EXPECT_EQ(numbers["source_to_target"]["flipped_count"], 0);
    EXPECT_EQ(numbers["target_to_source"]["flipped_count"], 0);
    const TriangleMesh back = cross_remesh(map.B_to_A, pair_.B, pair_.A);
    for (int v = 1; v < file.vertex_count(); ++v) EXPECT_LT((back.vertex(v) - file.vertex(v)).norm(), 1e-6);
}

/// Pairs of triangles as one quad where the second is the fan's next.
PolygonSoup as_polygons(const TriangleMesh& mesh) {
    PolygonSoup soup;
    for (const auto vertex : mesh.vertices.rowwise()) soup.points.push_back(vertex.transpose());
    for (int f = 0; f < mesh.face_count(); ++f) {
        for (const int v : mesh.faces.row(f)) soup.corners.push_back(v);
        const bool goes_on = f + 1 < mesh.face_count() && mesh.faces(f + 1, 0) == mesh.faces(f, 0) &&
                             mesh.faces(f + 1, 1) == mesh.faces(f, 2);
        if (goes_on) soup.corners.push_back(mesh.faces(++f, 2));
        soup.end_polygon();
    }
    return soup;
}

TEST_F(Remesh, KeepsPolygons) {
    const TriangleMesh file = file_as_read(pair_.A);
    PolygonSoup polygons = as_polygons(file);
    PointMap map = pair_.as_planned().A_to_B;
    const TriangleMesh moved = cross_remesh(map, pair_.A, pair_.B);
    const PolygonSoup kept = cross_remeshed_polygons(moved, polygons, map, pair_.A, pair_.B);
    EXPECT_EQ(kept.corners, polygons.corners);
    EXPECT_EQ(kept.ends, polygons.ends);
    EXPECT_EQ(kept.points.size(), std::size_t(moved.vertex_count()));
    for (const PlyFormat format : {PlyFormat::binary, PlyFormat::ascii}) {
        const TriangleMesh back = parse_mesh(to_ply(kept, format), "a.ply");
        EXPECT_EQ(back.vertices, moved.vertices);
        EXPECT_EQ(back.faces, moved.faces);
    }
    pair_.B.mirrored = !pair_.B.mirrored;
    const PolygonSoup turned = cross_remeshed_polygons(moved, polygons, map, pair_.A, pair_.B);
    EXPECT_EQ(turned.corners[0], polygons.corners[0]);
    EXPECT_EQ(turned.corners[1], polygons.corners[polygons.ends[0] - 1]);
    pair_.B.mirrored = !pair_.B.mirrored;
    polygons.corners[0] = polygons.corners[1];
    EXPECT_THROW(cross_remeshed_polygons(moved, polygons, map, pair_.A, pair_.B), InputError);
}

/// A quad of which one corner has no image keeps one triangle, or none.
TEST(CrossRemesh, LeavesOutTrianglesOfPolygonsWithoutImages) {
    Surface A, B;
    A.input.vertices = Points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}};
    A.input.faces = Faces{{0, 1, 2}, {0, 2, 3}, {1, 4, 2}};
    B.input = A.input;
    PolygonSoup polygons;
    for (const auto vertex : A.input.vertices.rowwise()) polygons.points.push_back(vertex.transpose());
    polygons.corners = {0, 1, 2, 3, 1, 4, 2};
    polygons.ends = {4, 7};
    PointMap map(5, SurfacePoint{0, Vec3::UnitX()});
    const auto sizes = [&](int lost) {
        PointMap holed = map;
        if (lost >= 0) holed[std::size_t(lost)].face = -1;
        const PolygonSoup kept = cross_remeshed_polygons(cross_remesh(holed, A, B), polygons, holed, A, B);
        std::vector<std::size_t> result;
        for (std::size_t p = 0; p < kept.ends.size(); ++p)
            result.push_back(kept.ends[p] - (p > 0 ? kept.ends[p - 1] : 0));
        return result;
    };
    EXPECT_EQ(sizes(-1), (std::vector<std::size_t>{4, 3}));
    EXPECT_EQ(sizes(3), (std::vector<std::size_t>{3, 3}));
    EXPECT_EQ(sizes(0), (std::vector<std::size_t>{3}));
    EXPECT_EQ(sizes(4), (std::vector<std::size_t>{4}));
}

TEST_F(Remesh, RefusesWhatIsNotOfItsSurfaces) {
    const SurfaceMap map = pair_.as_planned();
    EXPECT_NO_THROW(require_surfaces(map, pair_.A, pair_.B));
    SurfaceMap other = map;
    other.A_to_B[3].face = pair_.B.input.face_count();
    EXPECT_THROW(require_surfaces(other, pair_.A, pair_.B), ArtifactError);
    other = map;
    other.B_to_A.pop_back();
    EXPECT_THROW(require_surfaces(other, pair_.A, pair_.B), ArtifactError);
    SolvedPair pair = pair_.plan;
    EXPECT_NO_THROW(require_surfaces(pair, pair_.A, pair_.B));
    pair.plan.samples_B[0] = pair_.B.mesh.vertex_count();
    EXPECT_THROW(require_surfaces(pair, pair_.A, pair_.B), ArtifactError);
    pair = pair_.plan;
    pair.record.landmark_points = {{{pair_.A.input.face_count(), Vec3(1, 0, 0)}, {0, Vec3(1, 0, 0)}}};
    EXPECT_THROW(require_surfaces(pair, pair_.A, pair_.B), ArtifactError);
}

}  // namespace
}  // namespace varimap
