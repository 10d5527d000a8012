#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "fixtures/temporary_folder.h"
#include "varimap/core/printable.h"
#include "varimap/stage/known_hashes.h"
#include "varimap/stage/nearest_name.h"
#include "varimap/stage/parameter_text.h"
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
    int long_name = 0;
    void describe(ParameterList& list) {
        list.add("length", length, "target length, units of sqrt(area)", 0, 1);
        list.add("count", count, "number of things", 1, 100);
        list.add("aligned", aligned, "whether the surfaces are aligned");
        list.add("start", start, "where to start");
        list.add("long_name", long_name, "nothing", 0, 9);
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
        {"length", "0.25"}, {"count", "5"}, {"aligned", "false"}, {"start", "none"}, {"long_name", "0"}};
    EXPECT_EQ(artifact.header.parameters, expected);
}

TEST_F(StageRun, LogsParametersFirstAndResourcesLast) {
    const Outcome run = run_sample({in, out, "--threads", "3"});
    EXPECT_EQ(run.out, "");
    EXPECT_TRUE(
        run.err.starts_with("[sample] length=0.1 count=5 aligned=false start=none long_name=0 threads=3\n"))
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
        {[](Stage&) { throw std::bad_alloc(); }, 6},
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
    for (const char* part :
         {"--length", "units of sqrt(area)", "default 0.1", "from 0 to 1", "one of none, both",
          "true or false", "--threads", "--if-stale", "--config", "--parameters"})
        EXPECT_THAT(run.out, HasSubstr(part));
    EXPECT_EQ(run_sample({"--version"}).out, "varimap-sample " + version() + "\n");
}

TEST_F(StageRun, ConfigFileGivesWayToTheCommandLineAndOtherStagesSectionsDoNotCount) {
    write_file_atomically(
        folder / "preset.toml",
        "[sample]\nlength = 0.5\ncount = 9\naligned = true\nstart = \"both\"\n[eigen]\ncount = 3\n");
    TestParams params;
    EXPECT_EQ(run_sample({in, out, "--config", folder / "preset.toml", "--count", "8"}, {}, &params).code, 0);
    EXPECT_EQ(params.length, 0.5);
    EXPECT_EQ(params.count, 8);
    EXPECT_TRUE(params.aligned);
    EXPECT_EQ(params.start, TestStart::both);
}

TEST_F(StageRun, MistakesInAConfigFileNameFileLineAndNearestName) {
    const std::vector<std::pair<std::string, std::string>> mistakes{
        {"[sample]\ncuont = 9\n", "line 2: varimap-sample has no parameter cuont; did you mean count?"},
        {"cuont = 9\n", "line 1: varimap-sample has no parameter cuont"},
        {"\n# comment\n[eigne]\n", "line 3: no stage is called eigne; did you mean eigen?"},
        {"eigne.count = 3\n", "line 1: no stage is called eigne; did you mean eigen?"},
        {"[unheard_of]\n", "no stage is called unheard_of; there are "},
        {"[sample]\ncount = many\n", "line 2: --count: 'many' is not a whole number from 1 to 100"},
        {"[sample]\ncount = 1\ncount = 2\n", "line 3: count is there twice"},
        {"[sample]\ncount = [1, 2]\n", "line 2: neither"},
        {"[sample\ncount = 1\n", "line 1: neither"},
        {"count\n", "line 1: neither"},
        {"count =\n", "line 1: neither"},
        {"start = \"both\n", "line 1: neither"},
        {"start = \"both\" none\n", "line 1: neither"}};
    const std::string file = folder / "preset.toml";
    for (const auto& [text, message] : mistakes) {
        write_file_atomically(file, text);
        const Outcome run = run_sample({in, out, "--config", file});
        EXPECT_EQ(run.code, 2) << text;
        EXPECT_THAT(run.err, HasSubstr("error: " + file + ", ")) << text;
        EXPECT_THAT(run.err, HasSubstr(message)) << text;
        EXPECT_EQ(line_count(run.err), 1u) << run.err;
    }
}

TEST_F(StageRun, ConfigFilesMayHoldCommentsQuotesDashesAndDots) {
    write_file_atomically(folder / "preset.toml",
                          "\xef\xbb\xbf  # at the start\r\n\r\nsample.count = 7 # seven\r\n"
                          "['sample']\r\nlength=2.5e-1\r\n start = 'both' # quoted\r\n");
    TestParams params;
    ASSERT_EQ(run_sample({in, out, "--config=" + (folder / "preset.toml")}, {}, &params).code, 0);
    EXPECT_EQ(params.count, 7);
    EXPECT_EQ(params.length, .25);
    EXPECT_EQ(params.start, TestStart::both);
}

TEST_F(StageRun, DashesAndUnderscoresAreAlike) {
    for (const char* spelt : {"--long_name", "--long-name"}) {
        TestParams params;
        ASSERT_EQ(run_sample({in, out, spelt, "3"}, {}, &params).code, 0);
        EXPECT_EQ(params.long_name, 3);
        ASSERT_EQ(run_sample({in, out, std::string(spelt) + "=4"}, {}, &params).code, 0);
        EXPECT_EQ(params.long_name, 4);
    }
}

TEST_F(StageRun, AMistypedOptionIsAnsweredWithTheNearestOne) {
    EXPECT_THAT(run_sample({in, out, "--lenght", "1"}).err, HasSubstr("did you mean --length?"));
    EXPECT_THAT(run_sample({in, out, "--long-nam=1"}).err, HasSubstr("did you mean --long_name?"));
}

TEST_F(StageRun, PrintsTheParametersThatAreNotAtTheirDefaults) {
    write_file_atomically(folder / "preset.toml", "[sample]\ncount = 9\nlength = 0.5\n");
    EXPECT_EQ(run_sample({"--parameters"}).out, "");
    EXPECT_EQ(
        run_sample({"--parameters", "--config", folder / "preset.toml", "--count=5", "--start", "both"}).out,
        "--length 0.5 --start both\n");
    EXPECT_EQ(run_sample({"--parameters", "--count", "0"}).code, 2);
}

TEST_F(StageRun, ParametersAreAskedForWithParametersAlone) {
    for (const char* other : {"--stamp=x", "--threads=1", "--if-stale=x", "--files=x", "--version"}) {
        const Outcome run = run_sample({"--parameters", other});
        EXPECT_EQ(run.code, 2) << other;
        EXPECT_THAT(run.err, HasSubstr(" is not a parameter"));
    }
    EXPECT_THAT(run_sample({"--parameters", "--cuont=1"}).err,
                HasSubstr("cuont is not a parameter; did you mean count?"));
}

TEST(NearestName, CountsLettersAndGivesUpOnStrangers) {
    const std::vector<std::string> names{"tolerance", "gamma", "seed"};
    EXPECT_EQ(nearest_name("tolernace", names), "tolerance");
    EXPECT_EQ(nearest_name("gama", names), "gamma");
    EXPECT_EQ(nearest_name("gamma", names), "gamma");
    EXPECT_EQ(nearest_name("colour", names), "");
    EXPECT_EQ(nearest_name("", names), "");
    EXPECT_EQ(nearest_name(std::string(100000, 'g'), names), "");
}

TEST_F(StageRun, ValuesReadBackExactlyAndTheLastOneCounts) {
    for (const std::string text : {"0.1", "1e-09", "0.30000000000000004", "5e-324", "1"}) {
        TestParams params;
        ASSERT_EQ(run_sample({in, out, "--length", "0.7", "--length", text}, {}, &params).code, 0);
        EXPECT_EQ(read_header(out).parameters.front().second, text);
        EXPECT_EQ(fmt::format("{}", params.length), text);
    }
}

TEST(Parameters, ValuesOfProgramsAreHeldAgainstTheSameRanges) {
    double length = 1;
    int count = 3;
    ParameterList list;
    list.add("length", length, "", 0., 1.);
    list.add("count", count, "", 1, 3);
    EXPECT_NO_THROW(require_allowed(list));
    for (const double bad : {std::nextafter(1, 2), -1e-300, std::nan("")}) {
        length = bad;
        EXPECT_THROW(require_allowed(list), UsageError);
    }
    length = 0;
    count = 4;
    try {
        require_allowed(list);
        ADD_FAILURE() << "was accepted";
    } catch (const UsageError& error) {
        EXPECT_STREQ(error.what(), "count: '4' is not a whole number from 1 to 3");
    }
}

/// The sample stage asked to make its output only where that is not what it would write.
class IfStale : public StageRun {
  protected:
    void SetUp() override {
        StageRun::SetUp();
        std::filesystem::create_directory(folder / "hashes");
        ASSERT_EQ(run_sample({in, out}).code, 0);
    }
    bool runs(std::vector<std::string> extra = {}) {
        bool ran = false;
        std::vector<std::string> arguments{in, out, "--if-stale", folder / "hashes"};
        arguments.insert(arguments.end(), extra.begin(), extra.end());
        const Outcome run = run_sample(arguments, [&](Stage&) { ran = true; });
        EXPECT_EQ(run.code, 0) << run.err;
        EXPECT_EQ(run.err.empty(), !ran);
        return ran;
    }
    /// As it is, but for what `change` does to the header.
    void rewrite(const std::function<void(Header&)>& change) {
        auto [header, payload] = read_checked(out);
        change(header);
        write_payload(out, header, payload);
    }
    void set_times(const std::string& path, int seconds_from_now) {
        namespace fs = std::filesystem;
        fs::last_write_time(path, fs::file_time_type::clock::now() + std::chrono::seconds(seconds_from_now));
    }
};

TEST_F(IfStale, DoesNothingForWhatItWouldWriteAgain) {
    const std::string before = read_file(out);
    EXPECT_FALSE(runs());
    EXPECT_FALSE(runs({"--threads", "7"}));
    EXPECT_FALSE(runs({"--length", "1e-1"}));
    EXPECT_EQ(read_file(out), before);
}

TEST_F(IfStale, RunsForOtherParametersAndOutputs) {
    EXPECT_TRUE(runs({"--count", "6"}));
    EXPECT_TRUE(runs());
    for (const auto& missing : {out, out + ".run.json"}) {
        std::filesystem::remove(missing);
        EXPECT_TRUE(runs());
        EXPECT_FALSE(runs());
    }
    // The side file of another artifact: the stage was killed before it wrote its own.
    write_file_atomically(out + ".run.json", "{\"artifact\": \"" + content_hash("other") + "\"}");
    EXPECT_TRUE(runs());
    EXPECT_FALSE(runs());
}

TEST_F(IfStale, ContentDecidesAndTimesDoNot) {
    for (const int seconds : {-86400, 86400}) {
        set_times(in, seconds);
        EXPECT_FALSE(runs());
        set_times(out, 10 * seconds);
        EXPECT_FALSE(runs());
        write_file_atomically(in, "other input");
        set_times(in, -100 * 86400);
        EXPECT_TRUE(runs());
        EXPECT_FALSE(runs());
        write_file_atomically(in, "input");
        EXPECT_TRUE(runs());
    }
}

TEST_F(IfStale, RunsForOtherKindsSchemasStagesVersionsInputsAndDamagedFiles) {
    const std::vector<std::function<void(Header&)>> changes{
        [](Header& h) { h.kind = "surface"; },
        [](Header& h) { h.schema = 2; },
        [](Header& h) { h.stage = "varimap-other"; },
        [](Header& h) { h.parameters.pop_back(); },
        [](Header& h) { h.inputs.front().hash = "0"; },
        [](Header& h) { h.inputs.front().role = "other"; },
        [](Header& h) { h.inputs.clear(); },
        [](Header& h) { h.inputs.push_back(h.inputs.front()); }};
    rewrite([](Header&) {});
    EXPECT_FALSE(runs());
    for (const auto& change : changes) {
        rewrite(change);
        EXPECT_TRUE(runs());
        EXPECT_FALSE(runs());
    }
    Header older = read_header(out);
    const std::string rest = read_file(out).substr(header_text(older).size());
    older.version = "0.0.0";
    write_file_atomically(out, header_text(older) + rest);
    EXPECT_TRUE(runs());
    std::string bytes = read_file(out);
    bytes[bytes.size() - 40] ^= 1;
    write_file_atomically(out, bytes);
    EXPECT_TRUE(runs());
    write_file_atomically(out, "nothing of the kind");
    EXPECT_TRUE(runs());
}

TEST_F(IfStale, FilesThatAreNoArtifactsHaveAStamp) {
    const std::string stamp = folder / "stamp", first = folder / "first.txt", second = folder / "second.txt";
    bool ran = false;
    const auto make = [&](bool both, const std::string& count) {
        ran = false;
        const Outcome run =
            run_sample({in, out, "--if-stale", folder / "hashes", "--stamp", stamp, "--count", count},
                       [&](Stage& stage) {
                           ran = true;
                           stage.write_file(first, "first");
                           if (both) stage.write_file(second, "second");
                       });
        EXPECT_EQ(run.code, 0) << run.err;
        return ran;
    };
    EXPECT_TRUE(make(true, "5"));
    EXPECT_FALSE(make(true, "5"));
    write_file_atomically(first, "altered");
    EXPECT_TRUE(make(true, "5"));
    EXPECT_EQ(read_file(first), "first");
    std::filesystem::remove(second);
    EXPECT_TRUE(make(true, "5"));
    write_file_atomically(in, "other input");
    EXPECT_TRUE(make(true, "5"));
    // What it does not write any more is removed.
    EXPECT_TRUE(make(false, "6"));
    EXPECT_FALSE(std::filesystem::exists(second));
    EXPECT_FALSE(make(false, "6"));
    write_file_atomically(stamp, "damaged");
    EXPECT_TRUE(make(false, "6"));
}

TEST_F(IfStale, AFlagMakesAnotherFileThatIsNoArtifact) {
    const auto made_with = [&](std::vector<std::string> flags) {
        const std::string page = folder / "page", stamp = folder / "stamp", hashes = folder / "hashes";
        std::vector<std::string> words{"varimap-page", in, page, "--if-stale", hashes, "--stamp", stamp};
        words.insert(words.end(), flags.begin(), flags.end());
        std::vector<char*> argv;
        for (auto& word : words) argv.push_back(word.data());
        Stage stage("page", "A stage for tests");
        const std::string& source = stage.input("source", "any file");
        const std::string& output = stage.output("page", 0, "file to write");
        const bool& mirror = stage.flag("mirror", "another page");
        EXPECT_EQ(stage.main(int(argv.size()), argv.data(),
                             [&] {
                                 stage.record_file("source", source);
                                 stage.write_file(output, mirror ? "mirrored" : "upright");
                             }),
                  0);
        return read_file(page);
    };
    EXPECT_EQ(made_with({}), "upright");
    EXPECT_EQ(made_with({"--mirror"}), "mirrored");
    EXPECT_EQ(made_with({}), "upright");
}

TEST_F(IfStale, AFileAtRestIsReadOnceAndAChangedOneAgain) {
    std::time_t now = std::time(nullptr);
    const KnownHashes known(folder / "hashes", [&] { return now; });
    set_times(in, -3600);
    EXPECT_EQ(known.identify("mesh", in).hash, content_hash("input"));
    EXPECT_TRUE(std::filesystem::is_empty(folder / "hashes"));  // the file was changed just now
    now += 10;
    EXPECT_EQ(known.identify("mesh", in).hash, content_hash("input"));
    ASSERT_FALSE(std::filesystem::is_empty(folder / "hashes"));
    const std::filesystem::path memory = std::filesystem::directory_iterator(folder / "hashes")->path();
    // What is remembered is believed.
    std::string line = read_file(memory);
    line.resize(line.rfind('|') + 1);
    line.replace(line.find(content_hash("input")), 32, std::string(32, '0'));
    write_file_atomically(memory, line + content_hash(line) + "\n");
    EXPECT_EQ(known.identify("mesh", in).hash, std::string(32, '0'));
    // But not of a line that was cut, nor of other content of the same size and time.
    write_file_atomically(memory, line);
    EXPECT_EQ(known.identify("mesh", in).hash, content_hash("input"));
    const FileState before = file_state(in);
    const auto time = std::filesystem::last_write_time(in);
    do {  // the time of change cannot be set, and the file system's clock has steps
        std::ofstream(in, std::ios::in | std::ios::out) << "INPUT";
        std::filesystem::last_write_time(in, time);
    } while (file_state(in) == before);
    EXPECT_EQ(known.identify("mesh", in).hash, content_hash("INPUT"));
}

TEST_F(StageRun, TheLockIsHeldWhileTheOutputIsMadeAndLeavesNothing) {
    bool locked = false;
    ASSERT_EQ(run_sample({in, out},
                         [&](Stage&) {
                             const int file = ::open((out + ".lock").c_str(), O_RDONLY);
                             locked = file >= 0 && ::flock(file, LOCK_EX | LOCK_NB) != 0;
                             ::close(file);
                         })
                  .code,
              0);
    EXPECT_TRUE(locked);
    write_file_atomically(out + ".lock", "left by a kill");
    EXPECT_EQ(run_sample({in, out}).code, 0);
    EXPECT_EQ(folder.file_count(), 3u);
    write_file_atomically(out + ".lock", "left by a kill");
    EXPECT_EQ(run_sample({in, out, "--if-stale", folder / ""}).err, "");
    EXPECT_EQ(folder.file_count(), 3u);  // input, output and its side file
}

TEST_F(StageRun, TemporaryFilesOfTheDeadAreRemovedAndOthersStay) {
    for (const char* name : {"out.sample.tmp.0", "out.sample.run.json.tmp.7"})
        std::ofstream(folder / name) << "left by a kill";
    std::ofstream(folder / "out.sample.tmp.mine") << "no name of ours";
    const std::string held = folder / "out.sample.tmp.5";
    std::ofstream(held) << "being written";
    const int writer = ::open(held.c_str(), O_RDONLY);
    ASSERT_EQ(::flock(writer, LOCK_EX), 0);
    ASSERT_EQ(run_sample({in, out}).code, 0);
    EXPECT_FALSE(std::filesystem::exists(folder / "out.sample.tmp.0"));
    EXPECT_FALSE(std::filesystem::exists(folder / "out.sample.run.json.tmp.7"));
    EXPECT_TRUE(std::filesystem::exists(folder / "out.sample.tmp.mine"));
    EXPECT_TRUE(std::filesystem::exists(held));
    ::close(writer);
}

TEST_F(StageRun, WhatIsNoRegularFileIsNeitherReadNorReplaced) {
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    std::filesystem::create_directory(folder / "sub");
    for (const std::string& odd : {folder / "pipe", folder / "sub", std::string("/dev/null")}) {
        EXPECT_EQ(run_sample({odd, out}).code, 6) << odd;
        EXPECT_EQ(run_sample({in, odd}).code, 6) << odd;
        EXPECT_THROW(write_file_atomically(odd, "x"), IoError) << odd;
    }
    EXPECT_TRUE(std::filesystem::is_fifo(folder / "pipe"));
}

TEST_F(StageRun, AnInputThatChangesWhileItIsReadIsRefused) {
    const Outcome run = run_sample({in, out}, [&](Stage& stage) {
        write_file_atomically(in, "changed");
        stage.record_file("source", in);
    });
    EXPECT_EQ(run.code, 6);
    EXPECT_THAT(run.err, HasSubstr("changed while it was read"));
}

TEST_F(StageRun, TheSideFileHoldsTheNotesTheWarningsAndTheInputs) {
    const auto says = [](Stage&) {
        note("know of {}", "this");
        warn("look at {}", "this");
    };
    ASSERT_EQ(run_sample({in, out}, says).code, 0);
    const auto run = nlohmann::json::parse(read_file(out + ".run.json"));
    EXPECT_THAT(run["warnings"].get<std::vector<std::string>>(), testing::Contains("look at this"));
    EXPECT_THAT(run["notes"].get<std::vector<std::string>>(), testing::Contains("know of this"));
    EXPECT_EQ(run["inputs"]["source"], content_hash("input"));
}

TEST_F(StageRun, AFindingHasASideFileThatStaysWhileItIsTheSame) {
    const std::string copy = folder / "copy";
    const auto find = [&](const std::string& hash, double level) {
        std::string program = "varimap-copy", from = in, to = copy;
        std::array<char*, 3> argv{program.data(), from.data(), to.data()};
        Stage stage("copy", "A stage for tests");
        stage.input("source", "any file");
        stage.output("copy", 0, "file to write");
        testing::internal::CaptureStderr();
        EXPECT_EQ(stage.main(3, argv.data(),
                             [&] {
                                 stage.record_finding(hash);
                                 stage.record_number("level", level);
                             }),
                  0);
        testing::internal::GetCapturedStderr();
        return nlohmann::json::parse(read_file(copy + ".run.json"))["level"].get<double>();
    };
    EXPECT_EQ(find("one", 1), 1);
    EXPECT_EQ(find("one", 2), 1);
    EXPECT_EQ(find("two", 3), 3);
}

TEST_F(StageRun, AnErrorFileTakesTheMessage) {
    const std::string errors = folder / "errors";
    const Outcome run =
        run_sample({in, out, "--error-file", errors}, [](Stage&) { throw InputError("bad\x1b[2J"); });
    EXPECT_EQ(run.code, 3);
    EXPECT_THAT(run.err, testing::Not(HasSubstr("error")));
    EXPECT_EQ(read_file(errors), "3 varimap-sample: error: bad\\x1b[2J\n");
}

TEST_F(StageRun, WhatAnErrorFileCannotTakeIsSaidOnStderr) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
    const Outcome run =
        run_sample({in, out, "--error-file", "/dev/full"}, [](Stage&) { throw InputError("bad"); });
    EXPECT_EQ(run.code, 3);
    EXPECT_THAT(run.err, HasSubstr("varimap-sample: error: bad\n"));
}

TEST_F(StageRun, AnErrorFileTakesWhatIsSaidOfTheCommandLine) {
    const std::string errors = folder / "errors";
    for (const auto& file :
         std::vector<std::vector<std::string>>{{"--error-file", errors}, {"--error_file=" + errors}}) {
        std::vector<std::string> arguments{in, out, "--threads", "9999"};
        arguments.insert(arguments.end(), file.begin(), file.end());
        const Outcome run = run_sample(arguments);
        EXPECT_EQ(run.code, 2);
        EXPECT_EQ(run.err, "");
        EXPECT_THAT(read_file(errors), testing::StartsWith("2 varimap-sample: error: --threads: "));
        std::filesystem::remove(errors);
    }
}

TEST_F(StageRun, ARanFileTellsWhetherThereWasSomethingToDo) {
    const std::string ran = folder / "ran";
    const std::vector<std::string> arguments{in, out, "--if-stale", folder / "hashes", "--ran-file", ran};
    run_sample(arguments);
    EXPECT_EQ(read_file(ran), "sample\n");
    run_sample(arguments);
    EXPECT_EQ(read_file(ran), "sample\n");
    write_file_atomically(in, "other input");
    run_sample(arguments);
    EXPECT_EQ(read_file(ran), "sample\nsample\n");
}

TEST_F(StageRun, AnArtifactIsAnInputBeforeItIsRead) {
    const std::string part = folder / "part.sample";
    ASSERT_EQ(run_sample({in, part}).code, 0);
    std::string text;
    ASSERT_EQ(run_sample({in, out},
                         [&](Stage& stage) { text = stage.record("part", part).read<TestArtifact>().text; })
                  .code,
              0);
    EXPECT_EQ(text, "none");
    ASSERT_EQ(run_sample({in, out}, [&](Stage& stage) { stage.record("part", part); }).code, 0);
    EXPECT_EQ(read_header(out).input_hash("part"), read_header(part).payload_hash);
    const Outcome changed = run_sample({in, out}, [&](Stage& stage) {
        const RecordedInput input = stage.record("part", part);
        write_payload(part, input.header(), "other");
        input.read<TestArtifact>();
    });
    EXPECT_EQ(changed.code, 6);
    EXPECT_THAT(changed.err, HasSubstr("changed since this stage began"));
}

TEST_F(StageRun, RefusesInputsOfDifferentOrigin) {
    const auto write_made_from = [&](const std::string& path, const std::vector<InputRecord>& inputs) {
        Header header;
        header.kind = "sample", header.schema = 1, header.stage = "varimap-sample", header.inputs = inputs;
        write_payload(path, header, path);
    };
    const auto read_both = [&](const std::string& first, const std::string& second) {
        return run_sample({in, out}, [&](Stage& stage) {
            stage.read<TestArtifact>(first, folder / "first");
            stage.read<TestArtifact>(second, folder / "second");
        });
    };
    write_made_from(folder / "first", {{"surface", "surface", content_hash("one")}});
    write_made_from(folder / "second", {{"surface", "surface", content_hash("two")}});
    EXPECT_EQ(read_both("A.first", "B.second").code, 0);
    const Outcome refused = read_both("A.first", "A.second");
    EXPECT_EQ(refused.code, 4);
    EXPECT_THAT(refused.err, HasSubstr("made from another A.surface"));
    // The first says which second it was made from.
    write_made_from(folder / "first", {{"A.second", "sample", content_hash(folder / "second")}});
    EXPECT_EQ(read_both("first", "A.second").code, 0);
    write_made_from(folder / "first", {{"A.second", "sample", content_hash("another")}});
    EXPECT_EQ(read_both("first", "A.second").code, 4);
    const Outcome other_way = run_sample({in, out}, [&](Stage& stage) {
        stage.read<TestArtifact>("A.second", folder / "second");
        stage.read<TestArtifact>("first", folder / "first");
    });
    EXPECT_EQ(other_way.code, 4);
    // One that is recorded and not read, and a file that is read, too.
    const Outcome recorded = run_sample({in, out}, [&](Stage& stage) {
        stage.record("A.second", folder / "second");
        stage.record("first", folder / "first");
    });
    EXPECT_EQ(recorded.code, 4);
    write_made_from(folder / "first", {{"source", "mesh", content_hash("another input")}});
    EXPECT_EQ(read_both("first", "second").code, 4);
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
