#include "stages/remesh/remesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"
#include "stages/remesh/quality_json.h"

namespace varimap {
namespace {

using Json = nlohmann::json;

/// A sphere with a vertex no face uses in front of the others, scaled and moved.
Surface sphere_with_spare_vertex(double scale, const Vec3& centre) {
    const TriangleMesh sphere = shapes::ellipsoid(2);
    Surface surface = shapes::plain_surface(sphere);
    const int n = sphere.vertex_count();
    surface.input.vertices.resize(n + 1, 3);
    surface.input.vertices.row(0) << 3, 3, 3;
    surface.input.vertices.bottomRows(n) = sphere.vertices;
    surface.input.vertices *= scale;
    surface.input.vertices.rowwise() += centre.transpose();
    surface.input.faces.array() += 1;
    surface.vertex_of_input.insert(surface.vertex_of_input.begin(), -1);
    for (std::size_t v = 1; v < surface.vertex_of_input.size(); ++v) surface.vertex_of_input[v] = int(v) - 1;
    surface.scale = 1 / scale;
    surface.centre = centre;
    return surface;
}

class Remesh : public ::testing::Test {
  protected:
    Surface A_ = sphere_with_spare_vertex(2, Vec3(1, 2, 3)),
            B_ = sphere_with_spare_vertex(0.5, Vec3(-1, 0, 5));
    Plan plan_ = identity_plan();

    /// The map as the plan has it.
    SurfaceMap read_only() const {
        RemeshParams params;
        params.untangling.enabled = false;
        return made(params);
    }
    SurfaceMap made(const RemeshParams& params = {}) const {
        return remesh(A_, B_, plan_, read_out(plan_, A_, B_), params);
    }

    Plan identity_plan() const {
        Plan identity;
        SamplePlan& plan = identity.plan;
        const int n = A_.mesh.vertex_count();
        for (int v = 0; v < n; ++v) plan.samples_A.push_back(v);
        plan.samples_B = plan.samples_A;
        plan.mass_A = plan.mass_B = plan.transported_A = plan.transported_B = A_.mass;
        plan.entries.resize(n, n);
        plan.entries.setIdentity();
        identity.centre_A = identity.centre_B = A_.mesh.vertices;
        identity.record.landmarks = {{{5}, {5}}};
        identity.trace = {{0, 0, 0, 10, 12, 5, 120, 1e-2, 0.9, 1e-3},
                          {0, 0, 1, 10, 12, 5, 120, 1e-2, 0.8, 1e-3},
                          {1, 1, 0, n, n, 9, 500, 1e-3, 0.25, 1e-3}};
        return identity;
    }
};

TEST_F(Remesh, MapsInputVerticesToInputFaces) {
    const SurfaceMap map = read_only();
    ASSERT_EQ(int(map.A_to_B.size()), A_.input.vertex_count());
    EXPECT_EQ(map.A_to_B[0].face, -1);
    for (int v = 1; v < A_.input.vertex_count(); ++v) {
        ASSERT_GE(map.A_to_B[std::size_t(v)].face, 0);
        EXPECT_LT((position(B_.input, map.A_to_B[std::size_t(v)]) - B_.input.vertex(v)).norm(), 1e-12);
        EXPECT_LT((position(A_.input, map.B_to_A[std::size_t(v)]) - A_.input.vertex(v)).norm(), 1e-12);
    }
}

TEST_F(Remesh, CrossRemeshingMovesTheSourceOntoTheTarget) {
    const SurfaceMap map = read_only();
    const TriangleMesh moved = cross_remesh(map.A_to_B, A_, B_);
    EXPECT_EQ(moved.faces, A_.input.faces);
    EXPECT_LT((moved.vertices - B_.input.vertices).norm(), 1e-12)
        << "the spare vertex keeps its relative place";
}

TEST_F(Remesh, PinsLandmarksUnlessTheyAreSoft) {
    plan_.record.landmarks = {{{5}, {9}}};  // a wrong one
    SurfaceMap map = read_only();
    EXPECT_NEAR(Json::parse(map.quality)["landmarks"][0], 0, 1e-12);
    plan_.record.landmark_weight = .5;
    map = read_only();
    const Json quality = Json::parse(map.quality);
    EXPECT_EQ(quality["landmark_weight"], .5);
    EXPECT_GT(quality["landmarks"][0], .01);
}

TEST_F(Remesh, MapsLandmarksThatArePointsOntoEachOther) {
    plan_.record.landmarks = {{{A_.mesh.faces(3, 0)}, {B_.mesh.faces(3, 0)}}};
    plan_.record.landmark_points = {{{3, Vec3(.5, .3, .2)}, {3, Vec3(.3, .2, .5)}}};
    const auto residual = [](const SurfaceMap& map) {
        return Json::parse(map.quality)["landmarks"][0].get<double>();
    };
    const double before = residual(read_only());
    EXPECT_GT(before, .02);
    EXPECT_LT(residual(made()), .3 * before) << "the rest: the triangle lies below the sphere";
}

void expect_finite_numbers(const Json& json, const std::string& where) {
    if (json.is_structured())
        for (const auto& [key, value] : json.items()) expect_finite_numbers(value, where + "/" + key);
    else
        EXPECT_TRUE(json.is_number() ? std::isfinite(json.get<double>()) : json.is_string()) << where;
}

TEST_F(Remesh, QualityHasTheDocumentedKeys) {
    const Json quality = Json::parse(read_only().quality);
    expect_finite_numbers(quality, "");
    EXPECT_EQ(quality["energy"], 0.25);
    EXPECT_EQ(quality["area_bound"], 1);
    for (const char* side : {"source", "target"})
        for (const char* end : {"min", "max"}) EXPECT_EQ(quality["mass_ratio"][side][end], 1);
    ASSERT_EQ(quality["landmarks"].size(), 1u);
    EXPECT_NEAR(quality["landmarks"][0], 0, 1e-12);
    for (const char* direction : {"source_to_target", "target_to_source"}) {
        const Json& numbers = quality[direction];
        EXPECT_EQ(numbers["flipped_count"], 0);
        EXPECT_EQ(numbers["flipped_area_percent"], 0);
        EXPECT_NEAR(numbers["dirichlet_energy"], 1, 1e-9);
        EXPECT_NEAR(numbers["coverage"], 1, 1e-9);
        EXPECT_EQ(numbers["untangling"]["flipped_before"], 0);
        EXPECT_EQ(numbers["untangling"]["flipped_after"], 0);
        EXPECT_EQ(numbers["untangling"]["mirrored_parts"], 0);
        EXPECT_EQ(numbers["verification"]["reversed_count"], 0);
        EXPECT_EQ(numbers["verification"]["reversed_area_percent"], 0);
        EXPECT_EQ(numbers["verification"]["branch_points"], 0);
        EXPECT_NEAR(numbers["verification"]["signed_area_ratio"], 1, 1e-9);
        EXPECT_EQ(numbers["verification"]["degree"], 1);
        for (const char* name : {"area_ratio", "conformal_distortion"})
            for (const char* share : {"p01", "p05", "p50", "p95", "p99"})
                EXPECT_NEAR(numbers[name][share], 1, 1e-9);
    }
    EXPECT_NEAR(quality["round_trip"]["mean"], 0, 1e-12);
    EXPECT_NEAR(quality["round_trip"]["p95"], 0, 1e-12);
    EXPECT_EQ(quality["source"]["input_vertices"], A_.input.vertex_count());
    EXPECT_EQ(quality["target"]["input_faces"], B_.input.face_count());
    EXPECT_EQ(quality["source"]["vertices"], A_.mesh.vertex_count());
}

TEST_F(Remesh, TellsTransportedMassesOfInputVertices) {
    plan_.plan.transported_A[3] = 1.25 * plan_.plan.mass_A[3];
    EXPECT_NEAR(double(Json::parse(read_only().quality)["mass_ratio"]["source"]["max"]), 1.25, 1e-12);
    std::istringstream lines(
        masses_csv(A_, plan_.plan.samples_A, plan_.plan.transported_A, plan_.plan.mass_A));
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "vertex,ratio");
    int count = 0;
    while (std::getline(lines, line)) {
        const int vertex = std::stoi(line);
        EXPECT_EQ(line,
                  std::to_string(vertex) + (A_.vertex_of_input[std::size_t(vertex)] == 3 ? ",1.25" : ",1"));
        ++count;
    }
    EXPECT_EQ(count, A_.mesh.vertex_count());  // not the spare vertex
}

TEST_F(Remesh, Untangles) {
    for (int v = 40; v < 60; ++v) plan_.centre_A.row(v).swap(plan_.centre_A.row(v + 60));
    plan_.plan.samples_A.pop_back();  // so that the centres alone decide
    plan_.plan.entries.conservativeResize(int(plan_.plan.samples_A.size()), plan_.plan.entries.cols());
    const Json tangled = Json::parse(read_only().quality)["source_to_target"];
    EXPECT_GT(tangled["flipped_count"], 50);
    EXPECT_EQ(tangled["untangling"]["flipped_after"], tangled["flipped_count"]);
    const Json quality = Json::parse(made().quality)["source_to_target"];
    EXPECT_EQ(quality["untangling"]["flipped_before"], tangled["flipped_count"]);
    EXPECT_EQ(quality["untangling"]["flipped_after"], 0);
    EXPECT_EQ(quality["flipped_count"], 0);
    EXPECT_LT((position(B_.input, made().A_to_B[6]) - B_.input.vertex(6)).norm(), 1e-12)
        << "the landmark, behind the spare vertex";
}

TEST_F(Remesh, QualitySumsUpTheLevels) {
    const Json levels = Json::parse(read_only().quality)["levels"];
    ASSERT_EQ(levels.size(), 2u);
    EXPECT_EQ(levels[0]["kind"], "diffusion");
    EXPECT_EQ(levels[0]["iterations"], 2);
    EXPECT_EQ(levels[0]["energy"], 0.8);
    EXPECT_EQ(levels[0]["samples_target"], 12);
    EXPECT_EQ(levels[1]["kind"], "euclidean");
    EXPECT_EQ(levels[1]["iterations"], 1);
}

TEST_F(Remesh, QualityHoldsFiniteNumbersOnly) {
    plan_.trace.back().energy = std::nan("");
    plan_.trace.front().energy = std::numeric_limits<double>::infinity();
    const Json quality = Json::parse(read_only().quality);
    expect_finite_numbers(quality, "");
    EXPECT_FALSE(quality.contains("energy"));
}

TEST_F(Remesh, CollapsedMapsHaveFiniteQuality) {
    plan_.centre_A.setZero();
    plan_.plan.samples_A.pop_back();
    plan_.plan.entries.conservativeResize(int(plan_.plan.samples_A.size()), plan_.plan.entries.cols());
    const Json quality = Json::parse(read_only().quality);
    expect_finite_numbers(quality, "");
    EXPECT_GT(quality["source_to_target"]["flipped_area_percent"], 90);
}

TEST(QualityStages, AreNamedAfterStageAndArtifact) {
    const std::string folder = ::testing::TempDir() + "/remesh_runs";
    std::filesystem::create_directories(folder);
    const std::string basis = folder + "/cat.0.basis.run.json", broken = folder + "/dog.basis.run.json";
    write_file_atomically(basis, R"({"stage": "eigen", "wall_seconds": 2.5, "threads": 2})");
    write_file_atomically(broken, "{");
    const std::string text = with_stages(R"({"energy": 1.0})", {basis, broken, folder + "/none.run.json"},
                                         "remesh cat--dog", {1.5, 2, 30});
    std::filesystem::remove_all(folder);
    const Json quality = Json::parse(text);
    EXPECT_EQ(quality["energy"], 1.0);
    EXPECT_EQ(quality["stages"].size(), 2u);
    EXPECT_EQ(quality["stages"]["eigen cat.0"]["wall_seconds"], 2.5);
    EXPECT_EQ(quality["stages"]["remesh cat--dog"]["peak_megabytes"], 30);
}

TEST_F(Remesh, GivesPointsOnTheFacesOfTheFilesOfMirroredSurfaces) {
    // A is the mirror image of B, with its faces as the file has them: inside out until it is mirrored.
    A_.mesh.vertices.col(0) *= -1;
    A_.input.vertices.col(0) *= -1;
    plan_.centre_B = A_.mesh.vertices;
    const TriangleMesh file = with_reversed_orientation(A_).input;  // counter-clockwise from outside
    Surface A = A_;
    A.mirrored = true;
    A_ = A;
    const SurfaceMap map = read_only();
    EXPECT_EQ(Json::parse(map.quality)["source_to_target"]["flipped_count"], 0);
    EXPECT_EQ(Json::parse(map.quality)["target_to_source"]["flipped_count"], 0);
    for (int v = 1; v < B_.input.vertex_count(); ++v)
        EXPECT_LT((position(file, map.B_to_A[std::size_t(v)]) - file.vertex(v)).norm(), 1e-6);
    const TriangleMesh back = cross_remesh(map.B_to_A, B_, A_);
    for (int v = 1; v < B_.input.vertex_count(); ++v)
        EXPECT_LT((back.vertex(v) - file.vertex(v)).norm(), 1e-6);
}

}  // namespace
}  // namespace varimap
