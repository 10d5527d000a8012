#include "stages/inspect/inspect.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "fixtures/temporary_folder.h"
#include "stages/inspect/formats.h"
#include "varimap/artifact/artifact.h"
#include "varimap/artifact/npy.h"
#include "varimap/results/candidates.h"
#include "varimap/results/diffusion.h"
#include "varimap/results/plan.h"
#include "varimap/results/quality_numbers.h"
#include "varimap/results/surface_map.h"
#include "varimap/spectral/hierarchy.h"
#include "varimap/stage/stamp.h"

namespace varimap {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Two samples on a surface of three vertices, each mapped to the other side's same vertex.
Plan small_plan() {
    Plan small;
    SamplePlan& plan = small.plan;
    plan.samples_A = plan.samples_B = {0, 2};
    plan.mass_A = plan.mass_B = Eigen::Vector2d(0.25, 0.75);
    plan.transported_A = Eigen::Vector2d(0.3, 0.7);
    plan.transported_B = plan.mass_B;
    plan.area_bound = 2;
    plan.entries.resize(2, 2);
    plan.entries.insert(0, 0) = 0.25;
    plan.entries.insert(1, 1) = 0.75;
    plan.entries.makeCompressed();
    small.centre_A = small.centre_B = Points::Random(3, 3);
    small.record.landmarks = {{{0}, {0}}};
    small.record.landmark_points = {{SurfacePoint{0, Vec3(1, 0, 0)}, SurfacePoint{4, Vec3(.25, .25, .5)}}};
    small.trace = {TraceRow{}};
    return small;
}

Diffusion small_diffusion() {
    Diffusion diffusion;
    static_cast<SolvedPair&>(diffusion) = small_plan();
    diffusion.image_vertex_A = diffusion.image_vertex_B = {0, 1, 2};
    return diffusion;
}

template <class T>
void write_sample(const std::string& path, const T& value, const std::vector<InputRecord>& inputs = {}) {
    Header header;
    header.kind = ArtifactType<T>::kind;
    header.schema = ArtifactType<T>::schema;
    header.stage = "varimap-test";
    header.inputs = inputs;
    write_payload(path, header, encode(value));
}

/// The numbers behind the header of a .npy file.
std::vector<double> npy_doubles(const std::string& bytes) {
    const std::size_t start = 10 + std::uint8_t(bytes[8]) + 256 * std::uint8_t(bytes[9]);
    std::vector<double> values((bytes.size() - start) / sizeof(double));
    std::memcpy(values.data(), bytes.data() + start, values.size() * sizeof(double));
    return values;
}

TEST(Npy, HeaderSaysTypeOrderAndShapeAndEndsOnAMultipleOf64) {
    const Eigen::MatrixXd matrix = Eigen::MatrixXd::Random(3, 2);
    const std::string bytes = to_npy(view(matrix));
    EXPECT_TRUE(bytes.starts_with(std::string("\x93NUMPY\x01\x00", 8)));
    EXPECT_THAT(bytes, HasSubstr("{'descr': '<f8', 'fortran_order': True, 'shape': (3, 2, ), }"));
    EXPECT_EQ((bytes.size() - 6 * sizeof(double)) % 64, 0u);
    EXPECT_EQ(npy_doubles(bytes), std::vector<double>(matrix.data(), matrix.data() + 6));
    const std::vector<int> indices{1, 2, 3};
    EXPECT_THAT(to_npy(view(indices)),
                HasSubstr("{'descr': '<i4', 'fortran_order': False, 'shape': (3, ), }"));
}

TEST(MatrixMarket, CountsFromOneAndKeepsEveryDigit) {
    Eigen::SparseMatrix<double, Eigen::RowMajor> matrix(2, 3);
    matrix.insert(0, 2) = 0.1;
    matrix.insert(1, 0) = -1e-300;
    EXPECT_EQ(to_matrix_market(matrix),
              "%%MatrixMarket matrix coordinate real general\n2 3 2\n1 3 0.1\n2 1 -1e-300\n");
}

TEST(Inspect, SummaryShowsHeaderLineageAndContents) {
    const TemporaryFolder folder;
    Basis basis;
    basis.eigenvalues = basis.residuals = Eigen::Vector2d(0, 5);
    basis.functions = RowMatrix::Ones(3, 2);
    write_sample(folder / "A.basis", basis, {{"surface", "surface", content_hash("surface")}});
    const std::string hash = read_header(folder / "A.basis").payload_hash;
    write_sample(folder / "AB.plan", small_plan(), {{"basis_A", "basis", hash}});
    const std::string text = summarise(folder / "AB.plan");
    for (const std::string& part :
         {std::string("kind plan"), "basis_A: basis " + hash + " A.basis",
          "    surface: surface " + content_hash("surface"), std::string("sparse 2 x 2, 2 entries"),
          std::string("from 0.25 to 0.75, mean 0.5")})
        EXPECT_THAT(text, HasSubstr(part));
}

TEST(Inspect, CheckAcceptsEveryKindAndRefusesDamage) {
    const TemporaryFolder folder;
    Hierarchy hierarchy;
    hierarchy.levels.resize(1);
    hierarchy.levels[0].samples = hierarchy.levels[0].cell = {0};
    hierarchy.levels[0].mass = Eigen::VectorXd::Ones(1);
    hierarchy.levels[0].weights.resize(1, 1);
    hierarchy.levels[0].weights.insert(0, 0) = 1;
    hierarchy.levels.resize(3, hierarchy.levels[0]);
    hierarchy.levels[1].kind = hierarchy.levels[2].kind = LevelKind::euclidean;
    hierarchy.levels[2].full = true;
    hierarchy.shape = {RowMatrix::Zero(1, 3), Eigen::VectorXd::Zero(1)};
    write_sample(folder / "A.hierarchy", hierarchy);
    write_sample(folder / "AB.diffusion", small_diffusion());
    write_sample(folder / "AB.plan", small_plan());
    write_sample(folder / "AB.map", SurfaceMap{{SurfacePoint{0, Vec3(1, 0, 0)}}, {SurfacePoint{}}, {}});
    write_sample(folder / "AB.quality", QualityNumbers{"{}"});
    for (const char* name : {"A.hierarchy", "AB.diffusion", "AB.plan", "AB.map", "AB.quality"}) {
        const auto failure = check(folder / name);
        EXPECT_FALSE(failure) << failure->what();
        const std::string bytes = read_file(folder / name);
        write_file_atomically(folder / name, bytes.substr(0, bytes.size() - 1));
        EXPECT_EQ(check(folder / name)->code(), ExitCode::bad_artifact);
    }
    EXPECT_EQ(check(folder / "missing")->code(), ExitCode::input_output);
}

TEST(Inspect, CheckRefusesUnknownKindsAndPayloadsOfAnotherForm) {
    const TemporaryFolder folder;
    Header header;
    header.kind = "casserole";
    header.stage = "varimap-test";
    write_payload(folder / "a", header, "");
    EXPECT_EQ(check(folder / "a")->code(), ExitCode::bad_artifact);
    header.kind = "plan";
    header.schema = ArtifactType<Plan>::schema;
    write_payload(folder / "a", header, "not a plan");
    EXPECT_EQ(check(folder / "a")->code(), ExitCode::bad_artifact);
}

TEST(Inspect, StampsAreSummarisedByTheFilesTheySpeakOf) {
    const TemporaryFolder folder;
    write_file_atomically(folder / "table.csv", "1,2\n");
    Header header;
    header.kind = stamp_kind;
    header.schema = stamp_schema;
    header.stage = "varimap-test";
    header.inputs = {{"mesh", "off", content_hash("mesh")}};
    write_stamp(folder / ".stamp", header, {folder / "table.csv"});
    const std::string text = summarise(folder / ".stamp");
    EXPECT_THAT(text, HasSubstr("mesh: off " + content_hash("mesh")));
    EXPECT_THAT(text, testing::ContainsRegex("table.csv +" + content_hash("1,2\n")));
    EXPECT_FALSE(check(folder / ".stamp"));
}

TEST(Inspect, ExportWritesWhatTheArtifactHolds) {
    const TemporaryFolder folder;
    const Plan plan = small_plan();
    write_sample(folder / "AB.plan", plan);
    export_contents(folder / "AB.plan", folder / "deep/out");
    EXPECT_EQ(npy_doubles(read_file(folder / "deep/out/mass_A.npy")), (std::vector<double>{0.25, 0.75}));
    EXPECT_EQ(npy_doubles(read_file(folder / "deep/out/landmark_points_B_barycentric.npy")),
              (std::vector<double>{.25, .25, .5}));
    EXPECT_EQ(read_file(folder / "deep/out/plan.mtx"), to_matrix_market(plan.plan.entries));
    EXPECT_TRUE(read_file(folder / "deep/out/trace.csv").starts_with("level,euclidean,iteration,"));
}

TEST(Inspect, ExportWritesThePreviewsOfCandidates) {
    const TemporaryFolder folder;
    Candidates candidates;
    const SurfacePoint point{0, Vec3(.25, .75, 0)};
    candidates.list.resize(1);
    candidates.maps = {{{{point, point}}, {{point, point}}}};
    candidates.previews = {{point}};
    write_sample(folder / "AB.candidates", candidates);
    EXPECT_THAT(summarise(folder / "AB.candidates"), AllOf(HasSubstr("previews"), HasSubstr("right with")));
    Candidates self_maps = candidates;
    self_maps.sketched_A = self_maps.sketched_B = "one";
    write_sample(folder / "A.candidates", self_maps);
    EXPECT_THAT(summarise(folder / "A.candidates"), Not(HasSubstr("right with")));
    export_contents(folder / "AB.candidates", folder / "out");
    EXPECT_EQ(npy_doubles(read_file(folder / "out/preview_01_barycentric.npy")),
              (std::vector<double>{.25, .75, 0}));
}

TEST(Inspect, APlanFitsAScreen) {
    const TemporaryFolder folder;
    Plan plan = small_plan();
    plan.trace.assign(200, TraceRow{});
    write_sample(folder / "AB.plan", plan, {{"basis_A", "basis", content_hash("basis")}});
    const std::string text = summarise(folder / "AB.plan", Detail::screen);
    EXPECT_LT(std::count(text.begin(), text.end(), '\n'), 45);
    EXPECT_THAT(text, HasSubstr("plan of varimap-test"));
    EXPECT_THAT(text, HasSubstr("basis_A: basis"));
    EXPECT_THAT(text, HasSubstr("201 lines: --trace shows them"));
    EXPECT_GT(summarise(folder / "AB.plan").size(), 3 * text.size());
}

TEST(Inspect, LineageEndsWhereAnArtifactHasTheContentItWasMadeFrom) {
    const TemporaryFolder folder;
    Basis basis;
    basis.eigenvalues = basis.residuals = Eigen::Vector2d(0, 5);
    basis.functions = RowMatrix::Ones(3, 2);
    write_sample(folder / "b.basis", basis, {{"mesh", "off", content_hash("mesh")}});
    const std::string hash = read_header(folder / "b.basis").payload_hash;
    write_sample(folder / "a.basis", basis, {{"fine", "basis", hash}});
    const std::string text = summarise(folder / "a.basis");
    EXPECT_THAT(text, HasSubstr("fine: basis " + hash + " b.basis\n    mesh: off"));
}

TEST(Inspect, ExportsAPlanAsAnArrayThatSciPyReads) {
    const TemporaryFolder folder;
    write_sample(folder / "AB.plan", small_plan());
    export_contents(folder / "AB.plan", folder / "out");
    const auto files = from_zip(read_file(folder / "out/plan.npz"), "plan.npz");
    ASSERT_EQ(files.size(), 5u);
    EXPECT_EQ(npy_doubles(files.at("data.npy")), (std::vector<double>{.25, .75}));
    EXPECT_THAT(files.at("shape.npy"), HasSubstr("(2, )"));
    EXPECT_THAT(files.at("format.npy"), testing::EndsWith("csr"));
}

}  // namespace
}  // namespace varimap
