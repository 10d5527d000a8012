#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <nlohmann/json.hpp>

#include "fixtures/temporary_folder.h"
#include "varimap/stage/stage_main.h"

namespace varimap {

struct TestArtifact {
    std::string text;
};
template <>
struct ArtifactType<TestArtifact> {
    static constexpr const char* kind = "sample";
    static constexpr const char* stage = "varimap-sample";
    static constexpr int schema = 1;
};
std::string encode(const TestArtifact& sample) {
    return sample.text;
}
void decode(const std::string& payload, TestArtifact& sample) {
    sample.text = payload;
}

enum class TestStart : int { none, both };
template <>
struct EnumNames<TestStart> {
    static constexpr std::array names{"none", "both"};
};

namespace {

using testing::HasSubstr;

struct TestParams {
    double length = 0.1;
    int count = 5;
    bool aligned = false;
    TestStart start = TestStart::none;
    void describe(ParameterList& list) {
        list.add("length", length, "target length, units of sqrt(area)", 0, 1);
        list.add("count", count, "number of things", 1, 100);
        list.add("aligned", aligned, "whether the surfaces are aligned");
        list.add("start", start, "where to start");
    }
};

struct Outcome {
    int code;
    std::string out, err;
};

/// One command line of a small stage that writes a TestArtifact made from a file.
Outcome run_sample(std::vector<std::string> arguments, const std::function<void(Stage&)>& extra = {},
                   TestParams* used = nullptr) {
    arguments.insert(arguments.begin(), "varimap-sample");
    std::vector<char*> argv;
    for (auto& argument : arguments) argv.push_back(argument.data());
    TestParams params;
    Stage stage("sample", "A stage for tests");
    stage.parameters([&](ParameterList& list) { params.describe(list); });
    const std::string& in = stage.input("source", "any file");
    const std::string& out = stage.output("sample", 1, "artifact to write");
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const int code = stage.main(int(argv.size()), argv.data(), [&] {
        stage.record_file("source", in);
        stage.record_number("levels", 4);
        if (extra) extra(stage);
        stage.write(out, TestArtifact{name_of(params.start)});
    });
    if (used != nullptr) *used = params;
    return {code, testing::internal::GetCapturedStdout(), testing::internal::GetCapturedStderr()};
}

std::size_t line_count(const std::string& text) {
    return std::size_t(std::count(text.begin(), text.end(), '\n'));
}

class StageRun : public testing::Test {
  protected:
    void SetUp() override { write_file_atomically(in, "input"); }
    TemporaryFolder folder;
    std::string in = folder / "in", out = folder / "out.sample";
};

TEST_F(StageRun, WritesTheArtifactWithItsHistory) {
    EXPECT_EQ(run_sample({in, out, "--length", "0.25"}).code, 0);
    const auto artifact = read_artifact<TestArtifact>(out);
    EXPECT_EQ(artifact.value.text, "none");
    EXPECT_EQ(artifact.header.stage, "varimap-sample");
    EXPECT_EQ(artifact.header.input_hash("source"), content_hash("input"));
    const decltype(artifact.header.parameters) expected{
        {"length", "0.25"}, {"count", "5"}, {"aligned", "false"}, {"start", "none"}};
    EXPECT_EQ(artifact.header.parameters, expected);
}

TEST_F(StageRun, LogsParametersFirstAndResourcesLast) {
    const Outcome run = run_sample({in, out, "--threads", "3"});
    EXPECT_EQ(run.out, "");
    EXPECT_TRUE(run.err.starts_with("[sample] length=0.1 count=5 aligned=false start=none threads=3\n"))
        << run.err;
    const std::string last = run.err.substr(run.err.rfind('\n', run.err.size() - 2) + 1);
    EXPECT_THAT(last, testing::AllOf(HasSubstr("wall"), HasSubstr("CPU"), HasSubstr("peak memory")));
}

TEST_F(StageRun, WritesTheSideFile) {
    ASSERT_EQ(run_sample({in, out, "--threads", "2"}).code, 0);
    const auto run = nlohmann::json::parse(read_file(out + ".run.json"));
    EXPECT_EQ(run["stage"], "sample");
    EXPECT_EQ(run["threads"], 2);
    EXPECT_EQ(run["levels"], 4.0);
    for (const char* key : {"wall_seconds", "cpu_seconds", "peak_megabytes"})
        EXPECT_GE(run[key].get<double>(), 0);
}

TEST_F(StageRun, BytesDoNotDependOnThreads) {
    ASSERT_EQ(run_sample({in, out, "--threads", "1"}).code, 0);
    const std::string one = read_file(out);
    ASSERT_EQ(run_sample({in, out, "--threads", "4"}).code, 0);
    EXPECT_EQ(read_file(out), one);
}

TEST_F(StageRun, LimitsTheThreadsOfTheBody) {
    using tbb::global_control;
    std::size_t limit = 0;
    run_sample({in, out, "--threads", "1"}, [&](Stage&) {
        limit = global_control::active_value(global_control::max_allowed_parallelism);
    });
    EXPECT_EQ(limit, 1u);
}

TEST_F(StageRun, MistakesOnTheCommandLineExitWith2AndOneLine) {
    const std::vector<std::vector<std::string>> mistakes{{},
                                                         {in},
                                                         {in, out, "third"},
                                                         {in, out, "--unknown", "1"},
                                                         {in, out, "--length"},
                                                         {in, out, "--length", "2"},
                                                         {in, out, "--length", "nan"},
                                                         {in, out, "--length", "0,5"},
                                                         {in, out, "--length", "0.5x"},
                                                         {in, out, "--count", "0"},
                                                         {in, out, "--count", "2.5"},
                                                         {in, out, "--count", "99999999999"},
                                                         {in, out, "--aligned", "perhaps"},
                                                         {in, out, "--start", "middle"},
                                                         {in, out, "--threads", "0"},
                                                         {in, in}};
    for (const auto& arguments : mistakes) {
        const Outcome run = run_sample(arguments);
        const std::string shown = testing::PrintToString(arguments);
        EXPECT_EQ(run.code, 2) << shown;
        EXPECT_EQ(line_count(run.err), 1u) << shown << run.err;
        EXPECT_TRUE(run.err.starts_with("varimap-sample: error: ")) << run.err;
    }
    EXPECT_EQ(folder.file_count(), 1u);
    EXPECT_EQ(read_file(in), "input");
}

TEST_F(StageRun, EveryFailureHasItsExitCodeAndWritesNothing) {
    const std::vector<std::pair<std::function<void(Stage&)>, int>> failures{
        {[](Stage&) { throw UsageError("u"); }, 2},
        {[](Stage&) { throw InputError("i"); }, 3},
        {[](Stage&) { throw ArtifactError("a"); }, 4},
        {[](Stage&) { throw ConvergenceError("c"); }, 5},
        {[](Stage&) { throw IoError("o"); }, 6},
        {[](Stage&) { throw std::bad_alloc(); }, 70},
        {[](Stage&) { throw std::runtime_error("two\nlines"); }, 70},
        {[](Stage&) { throw 1; }, 70}};
    for (const auto& [fail, code] : failures) {
        const Outcome run = run_sample({in, out}, fail);
        EXPECT_EQ(run.code, code);
        EXPECT_EQ(line_count(run.err), 2u) << run.err;  // parameters, then the error
        EXPECT_THAT(run.err, HasSubstr("varimap-sample: error: "));
        EXPECT_EQ(folder.file_count(), 1u);
    }
}

TEST_F(StageRun, AFailingRunKeepsTheOldArtifact) {
    ASSERT_EQ(run_sample({in, out}).code, 0);
    const std::string old = read_file(out);
    EXPECT_EQ(run_sample({in, out, "--count", "7"}, [](Stage&) { throw ConvergenceError("c"); }).code, 5);
    EXPECT_EQ(read_file(out), old);
}

TEST_F(StageRun, UnreachableFilesExitWith6BeforeTheWork) {
    bool worked = false;
    const auto note = [&](Stage&) { worked = true; };
    EXPECT_EQ(run_sample({folder / "missing", out}).code, 6);
    EXPECT_EQ(run_sample({in, folder / "none/out"}, note).code, 6);
    EXPECT_EQ(run_sample({in, folder / ""}, note).code, 6);
    EXPECT_EQ(run_sample({in, out, "--config", folder / "missing.toml"}, note).code, 6);
    EXPECT_FALSE(worked);
}

TEST_F(StageRun, HelpNamesDefaultAndRange) {
    const Outcome run = run_sample({"--help"});
    EXPECT_EQ(run.code, 0);
    for (const char* part : {"--length", "units of sqrt(area)", "default 0.1", "from 0 to 1",
                             "one of none, both", "true or false", "--threads", "--stale", "--config"})
        EXPECT_THAT(run.out, HasSubstr(part));
    EXPECT_EQ(run_sample({"--version"}).out, "varimap-sample " + version() + "\n");
}

TEST_F(StageRun, ConfigFileGivesWayToTheCommandLineAndOtherStagesSectionsDoNotCount) {
    write_file_atomically(
        folder / "preset.toml",
        "[sample]\nlength = 0.5\ncount = 9\naligned = true\nstart = \"both\"\n[other]\ncount = 3\n");
    TestParams params;
    EXPECT_EQ(run_sample({in, out, "--config", folder / "preset.toml", "--count", "8"}, {}, &params).code, 0);
    EXPECT_EQ(params.length, 0.5);
    EXPECT_EQ(params.count, 8);
    EXPECT_TRUE(params.aligned);
    EXPECT_EQ(params.start, TestStart::both);
}

TEST_F(StageRun, ConfigFileWithUnknownOrBadEntriesExitsWith2) {
    for (const char* bad : {"[sample]\ncuont = 9\n", "[sample]\ncount = many\n", "cuont = 9\n"}) {
        write_file_atomically(folder / "preset.toml", bad);
        EXPECT_EQ(run_sample({in, out, "--config", folder / "preset.toml"}).code, 2) << bad;
    }
}

TEST_F(StageRun, ValuesReadBackExactlyAndTheLastOneCounts) {
    for (const std::string text : {"0.1", "1e-09", "0.30000000000000004", "5e-324", "1"}) {
        TestParams params;
        ASSERT_EQ(run_sample({in, out, "--length", "0.7", "--length", text}, {}, &params).code, 0);
        EXPECT_EQ(read_header(out).parameters.front().second, text);
        EXPECT_EQ(fmt::format("{}", params.length), text);
    }
}

class Stale : public StageRun {
  protected:
    void SetUp() override {
        StageRun::SetUp();
        ASSERT_EQ(run_sample({in, out}).code, 0);
    }
};

TEST_F(Stale, PrintsNothingForWhatItWouldWriteAgain) {
    const Outcome run = run_sample({"--stale", out, folder / "missing"});
    EXPECT_EQ(run.code, 0);
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(run_sample({"--threads", "7", "--stale", out}).out, "");
    EXPECT_EQ(run_sample({"--length", "1e-1", "--stale", out}).out, "");
}

TEST_F(Stale, PrintsOtherParameters) {
    EXPECT_EQ(run_sample({"--count", "6", "--stale", out}).out, out + "\n");
    EXPECT_EQ(run_sample({"--stale", out, "--start", "both"}).out, out + "\n");
}

TEST_F(Stale, PrintsOtherKindsSchemasStagesAndDamagedFiles) {
    const auto [header, payload] = read_checked(out);
    const auto stale_after = [&, h = header, p = payload](const std::function<void(Header&)>& change) {
        Header changed = h;
        change(changed);
        write_payload(out, changed, p);
        return run_sample({"--stale", out}).out == out + "\n";
    };
    EXPECT_FALSE(stale_after([](Header&) {}));
    EXPECT_TRUE(stale_after([](Header& h) { h.kind = "surface"; }));
    EXPECT_TRUE(stale_after([](Header& h) { h.schema = 2; }));
    EXPECT_TRUE(stale_after([](Header& h) { h.stage = "varimap-other"; }));
    EXPECT_TRUE(stale_after([](Header& h) { h.parameters.pop_back(); }));
    std::string bytes = read_file(out);
    bytes[bytes.size() / 2] ^= 1;
    write_file_atomically(out, bytes);
    const Outcome run = run_sample({"--stale", in, out});
    EXPECT_EQ(run.code, 0);
    EXPECT_EQ(run.out, in + "\n" + out + "\n");
}

TEST_F(Stale, PrintsOtherVersions) {
    auto [header, payload] = read_checked(out);
    header.version = "0.0.0";
    write_file_atomically(out,
                          header_text(header) + read_file(out).substr(header_text(read_header(out)).size()));
    EXPECT_EQ(read_header(out).version, "0.0.0");
    EXPECT_EQ(run_sample({"--stale", out}).out, out + "\n");
}

TEST(Lineage, AcceptsTheParentAndRefusesAnother) {
    Header parent, other, child;
    parent.payload_hash = content_hash("parent");
    other.payload_hash = content_hash("other");
    child.stage = "varimap-eigen";
    child.inputs = {{"surface", "surface", parent.payload_hash}};
    EXPECT_NO_THROW(Stage::require_lineage(child, "c", "surface", parent, "p"));
    EXPECT_THROW(Stage::require_lineage(child, "c", "surface", other, "o"), ArtifactError);
    EXPECT_THROW(Stage::require_lineage(child, "c", "surface_A", parent, "p"), ArtifactError);
}

}  // namespace
}  // namespace varimap
