#include "varimap/stage/stage_main.h"

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>

#include "varimap/artifact/temporaries.h"
#include "varimap/core/logged.h"
#include "varimap/core/printable.h"
#include "varimap/core/timing.h"
#include "varimap/stage/command_line.h"
#include "varimap/stage/file_lock.h"
#include "varimap/stage/known_hashes.h"
#include "varimap/stage/process.h"
#include "varimap/stage/reporting.h"
#include "varimap/stage/stamp.h"

namespace varimap {

namespace fs = std::filesystem;

#if defined(__AVX2__) && defined(__FMA__)
namespace {

/// Comes before all else that was compiled for such processors, and would end without a word.
[[gnu::constructor(101)]] void require_processor() {
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return;
    std::fputs(
        "varimap: error: built for processors with AVX2 and FMA, and this one has not both; build varimap on "
        "this machine, or anywhere with -DVARIMAP_PROCESSOR=x86-64\n",
        stderr);
    ::_exit(int(ExitCode::input_output));
}

}  // namespace
#endif

namespace {

nlohmann::ordered_json printable_list(const std::vector<std::string>& messages) {
    auto list = nlohmann::ordered_json::array();
    for (const std::string& message : messages) list.push_back(printable(message));
    return list;
}

}  // namespace

struct Stage::State {
    CommandLine line;
    std::string output_kind;
    int output_schema = 0;
    const std::string* output_path = nullptr;
    std::vector<const std::string*> output_options;
    std::vector<InputRecord> inputs;
    std::map<std::string, FileState> states_at_start;  ///< of the input files
    std::vector<InputRecord> identities;               ///< of the input files, where a stamp needs them
    struct Origin {
        std::string hash, path;  ///< of what was read first that names it
    };
    std::map<std::string, Origin> origins;  ///< by role, of what is read and what that was made from
    std::vector<std::string> files;         ///< written by write_file
    std::map<std::string, double> numbers;
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    std::string written_hash;  ///< of the artifact's payload; empty: none was written

    Header header(std::string kind, std::vector<InputRecord> from) const;
    std::vector<InputRecord> identify_inputs() const;
    std::vector<std::string> told_by() const;
    bool is_current() const;
    bool artifact_is_current(const KnownHashes& known, const Header& now) const;
    bool stamp_is_current(const KnownHashes& known, const Header& now) const;
    std::string run_file() const { return *output_path + ".run.json"; }
    bool run_file_tells_of(const std::string& hash) const;
    std::vector<std::string> outputs() const;
    void require_possible_files() const;
    void require_possible_output(const std::string& path) const;
    void log_parameters() const;
    void note_run() const;
    bool asks_for_json(int argc, char** argv) const;
};

Header Stage::State::header(std::string kind, std::vector<InputRecord> from) const {
    Header header;
    header.kind = std::move(kind);
    header.schema = header.kind == stamp_kind ? stamp_schema : output_schema;
    header.stage = "varimap-" + line.stage;
    header.version = version();
    header.parameters = line.parameters.resolved();
    if (header.kind == stamp_kind)  // what is no artifact has its meaning from flags, too
        for (const auto& flag : line.flags)
            if (flag.value) header.parameters.emplace_back("--" + flag.name, "");
    header.inputs = std::move(from);
    return header;
}

std::vector<InputRecord> Stage::State::identify_inputs() const {
    const KnownHashes known(line.if_stale);
    std::vector<InputRecord> found;
    for (const auto& [role, path] : line.input_files()) found.push_back(known.identify(role, path));
    return found;
}

/// What tells whether the output is current, besides the inputs.
std::vector<std::string> Stage::State::told_by() const {
    std::vector<std::string> paths;
    if (output_schema > 0) paths = {*output_path, run_file()};
    if (!line.stamp.empty()) paths.push_back(line.stamp);
    return paths;
}

/// Nothing is done for what is there already; what is missing or damaged is made.
bool Stage::State::is_current() const {
    if (line.if_stale.empty() || output_path == nullptr) return false;
    if (output_schema == 0 && line.stamp.empty()) return false;
    // Before anything is hashed, which takes longer than some stages.
    std::error_code ignored;
    for (const auto& path : told_by())
        if (!fs::exists(path, ignored)) return false;
    try {
        const auto from = identify_inputs();
        const KnownHashes known(line.if_stale);
        if (output_schema > 0 && !artifact_is_current(known, header(output_kind, from))) return false;
        return line.stamp.empty() || stamp_is_current(known, header(stamp_kind, from));
    } catch (const ArtifactError& damaged) {
        log("{}; making it anew", damaged.what());
        return false;
    } catch (const Error&) {
        return false;
    }
}

bool Stage::State::run_file_tells_of(const std::string& hash) const {
    std::error_code ignored;
    return fs::exists(run_file(), ignored) &&
           read_file(run_file()).find("\"artifact\": \"" + hash + "\"") != std::string::npos;
}

/// The side file is written last: it tells that the stage was not killed before.
bool Stage::State::artifact_is_current(const KnownHashes& known, const Header& now) const {
    const InputRecord there = known.identify("", *output_path);
    return there.kind == output_kind && would_be_written(now, read_header(*output_path)) &&
           run_file_tells_of(there.hash);
}

bool Stage::State::stamp_is_current(const KnownHashes& known, const Header& now) const {
    const Stamp stamp = read_stamp(line.stamp);
    const auto paths = paths_of_stamp(line.stamp);
    for (std::size_t i = 0; i < paths.size(); ++i)
        if (known.identify("", paths[i]).hash != stamp.files[i].hash) return false;
    return would_be_written(now, stamp.header);
}

/// All that the stage has written before, or is about to.
std::vector<std::string> Stage::State::outputs() const {
    std::vector<std::string> paths;
    if (output_path != nullptr) paths = {*output_path, run_file()};
    if (!line.stamp.empty()) paths.push_back(line.stamp);
    for (const auto& file : paths_of_stamp(line.stamp)) paths.push_back(file);
    return paths;
}

/// Opening a pipe would wait for its writer for ever.
void Stage::State::require_possible_files() const {
    for (const auto& [role, path] : line.input_files()) file_state(path);
    if (output_path != nullptr) require_possible_output(*output_path);
    for (const std::string* path : output_options)
        if (!path->empty()) require_possible_output(*path);
}

/// Found out before the work, not after it.
void Stage::State::require_possible_output(const std::string& path) const {
    std::error_code ignored;
    const auto parent = fs::path(path).parent_path();
    const std::string folder = parent.empty() ? "." : parent.string();
    if (!fs::is_directory(folder, ignored))
        throw IoError("cannot write '" + path + "': there is no folder '" + folder + "'");
    if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored))
        throw IoError("cannot write '" + path + "': it is there and not a regular file");
    if (::access(folder.c_str(), W_OK) != 0)
        throw IoError("cannot write '" + path + "': no permission to write in '" + folder + "'");
    for (const auto& [role, input] : line.input_files())
        if (fs::equivalent(input, path, ignored))
            throw UsageError("'" + path + "' is both an input and the output");
}

void Stage::State::log_parameters() const {
    std::string text;
    for (const auto& [name, value] : line.parameters.resolved()) text += fmt::format("{}={} ", name, value);
    log("{}threads={}", text, line.threads);
}

void Stage::State::note_run() const {
    if (line.ran_file.empty()) return;
    std::ofstream notes(line.ran_file, std::ios::app);
    if (!(notes << line.stage << std::endl)) throw IoError("cannot write '" + line.ran_file + "'");
}

/// Also of a command line that is refused.
bool Stage::State::asks_for_json(int argc, char** argv) const {
    return std::any_of(line.flags.begin(), line.flags.end(),
                       [](const auto& flag) { return flag.name == "json"; }) &&
           std::find(argv, argv + argc, std::string("--json")) != argv + argc;
}

Stage::Stage(const std::string& name, const std::string& summary) : state_(std::make_unique<State>()) {
    state_->line.stage = name;
    state_->line.summary = summary;
    set_log_name(name);
}

Stage::~Stage() = default;

void Stage::parameters(const std::function<void(ParameterList&)>& describe) {
    describe(state_->line.parameters);
}

const std::string& Stage::input(const std::string& role, const std::string& help) {
    return state_->line.positionals.emplace_back(CommandLine::Text{role, help, CommandLine::Use::input, {}})
        .value;
}

const std::string& Stage::word(const std::string& role, const std::string& help) {
    return state_->line.positionals.emplace_back(CommandLine::Text{role, help, CommandLine::Use::other, {}})
        .value;
}

const std::vector<std::string>& Stage::input_list(const std::string& role, const std::string& help) {
    return state_->line.files
        .emplace(CommandLine::TextList{role, help, CommandLine::Use::input, 1, 1 << 20, {}})
        .values;
}

const std::vector<std::string>& Stage::word_list(const std::string& role, const std::string& help) {
    return state_->line.files
        .emplace(CommandLine::TextList{role, help, CommandLine::Use::other, 1, 1 << 20, {}})
        .values;
}

const std::string& Stage::output(const std::string& kind, int schema, const std::string& help) {
    state_->output_kind = kind;
    state_->output_schema = schema;
    // "output-" keeps the name apart from an input of the same kind.
    auto& positionals = state_->line.positionals;
    const std::string& path =
        positionals.emplace_back(CommandLine::Text{"output-" + kind, help, CommandLine::Use::other, {}})
            .value;
    state_->output_path = &path;
    return path;
}

const std::string& Stage::input_option(const std::string& name, const std::string& help) {
    return state_->line.options.emplace_back(CommandLine::Text{name, help, CommandLine::Use::input, {}})
        .value;
}

const std::vector<std::string>& Stage::input_list_option(const std::string& name, const std::string& help,
                                                         int minimum, int maximum) {
    return state_->line.list_options
        .emplace_back(CommandLine::TextList{name, help, CommandLine::Use::input, minimum, maximum, {}})
        .values;
}

const std::string& Stage::option(const std::string& name, const std::string& help) {
    return state_->line.options.emplace_back(CommandLine::Text{name, help, CommandLine::Use::other, {}})
        .value;
}

const std::string& Stage::output_option(const std::string& name, const std::string& help) {
    const std::string& path = option(name, help);
    state_->output_options.push_back(&path);
    return path;
}

const bool& Stage::flag(const std::string& name, const std::string& help) {
    return state_->line.flags.emplace_back(CommandLine::Flag{name, help}).value;
}

int Stage::main(int argc, char** argv, const std::function<void()>& body) {
    open_standard_descriptors();
    std::signal(SIGXFSZ, SIG_IGN);  // writing fails instead, which is reported
    const ErrorReport report{"varimap-" + state_->line.stage, state_->line.error_file,
                             state_->asks_for_json(argc, argv)};
    return guarded(report, [&] {
        if (const auto text = state_->line.parse(argc, argv)) return print_result(*text);
        state_->require_possible_files();
        for (const auto& path : state_->outputs()) remove_dead_temporaries(path);
        if (state_->is_current() && !FileLock::exists(*state_->output_path)) return;
        std::optional<FileLock> lock;
        if (state_->output_path != nullptr) lock.emplace(*state_->output_path);
        // Another run may have made it while this one waited, or been killed before it removed its lock.
        if (!state_->is_current()) run(body);
    });
}

static void log_timed_parts() {
    std::string text;
    for (const auto& [part, seconds] : timed_parts())
        text += fmt::format("{}{} {:.2f} s", text.empty() ? "" : ", ", part, seconds);
    if (!text.empty()) log("time: {}", text);
}

void Stage::run(const std::function<void()>& body) {
    State& state = *state_;
    for (const auto& [role, path] : state.line.input_files()) state.states_at_start[path] = file_state(path);
    if (!state.line.stamp.empty()) state.identities = state.identify_inputs();
    state.log_parameters();
    state.note_run();
    using tbb::global_control;
    const global_control limit(global_control::max_allowed_parallelism, std::size_t(threads()));
    body();
    log_timed_parts();
    if (std::fflush(stdout) != 0) throw IoError("cannot write to standard output");
    write_run_file();
    if (!state.line.stamp.empty())
        write_stamp(state.line.stamp, state.header(stamp_kind, state.identities), state.files);
    const Usage used = usage();
    log("done: wall {:.2f} s, CPU {:.2f} s, peak memory {:.0f} MB", used.wall_seconds, used.cpu_seconds,
        used.peak_megabytes);
}

RecordedInput Stage::record(const std::string& role, const std::string& path) {
    Header header = read_header(path);
    record_input({role, header.kind, header.payload_hash});
    require_same_origin(role, header, path);
    return {path, std::move(header)};
}

void Stage::record_file(const std::string& role, const std::string& path) {
    record_input({role, kind_of_file(path), file_hash(path)});
    const auto start = state_->states_at_start.find(path);
    if (start != state_->states_at_start.end() && start->second != file_state(path))
        throw IoError("'" + path + "' changed while it was read; run again");
    require_origin(role, state_->inputs.back().hash, path);
}

void Stage::record_input(InputRecord record) {
    state_->inputs.push_back(std::move(record));
}

void Stage::require_origin(const std::string& role, const std::string& hash, const std::string& path) {
    const auto& known = state_->origins.try_emplace(role, State::Origin{hash, path}).first->second;
    if (known.hash == hash) return;
    throw ArtifactError(
        fmt::format("'{}' and '{}' do not belong together: each was made from another {}; "
                    "rerun the stages that wrote them",
                    known.path, path, role));
}

/// The surface of A.basis is A.surface; that of a plan has its side in its name already; files of one list
/// are made from whatever they are. What was coarsened twice was made from another of its own role.
void Stage::require_same_origin(const std::string& role, const Header& header, const std::string& path) {
    require_origin(role, header.payload_hash, path);
    const bool is_listed =
        role.find('.') != std::string::npos && !role.starts_with("A.") && !role.starts_with("B.");
    const std::string side = is_listed ? role + "." : role.substr(0, role.find('.') + 1);
    for (const auto& input : header.inputs)
        if (side + input.role != role) require_origin(side + input.role, input.hash, path);
}

void Stage::require_lineage(const Header& child, const std::string& child_path, const std::string& role,
                            const Header& parent, const std::string& parent_path) {
    if (child.input_hash(role) == parent.payload_hash) return;
    throw ArtifactError(fmt::format("'{}' was not made from '{}' ({}); rerun {}", child_path, parent_path,
                                    role, child.stage));
}

void Stage::record_finding(const std::string& hash) {
    if (!state_->run_file_tells_of(hash)) state_->written_hash = hash;
}

void Stage::record_number(const std::string& name, double value) {
    state_->numbers[name] = value;
}

int Stage::threads() const {
    return state_->line.threads;
}

Stage::Usage Stage::usage() const {
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - state_->start;
    return {wall.count(), cpu_seconds(), peak_megabytes()};
}

void Stage::write_encoded(const std::string& path, const std::string& kind, int schema,
                          const std::string& payload) {
    Header header = state_->header(state_->output_kind, state_->inputs);
    if (header.kind != kind || header.schema != schema)
        throw std::logic_error("varimap-" + state_->line.stage + " declared another output than a " + kind);
    write_payload(path, std::move(header), payload);
    state_->written_hash = content_hash(payload);
}

void Stage::write_file(const std::string& path, const std::string& bytes) {
    write_file_atomically(path, bytes);
    state_->files.push_back(path);
}

void Stage::write_run_file() const {
    if (state_->written_hash.empty()) return;
    const Usage used = usage();
    nlohmann::ordered_json run;
    run["stage"] = state_->line.stage;
    run["version"] = version();
    run["wall_seconds"] = used.wall_seconds;
    run["cpu_seconds"] = used.cpu_seconds;
    run["peak_megabytes"] = used.peak_megabytes;
    run["threads"] = threads();
    for (const auto& [name, value] : state_->numbers) run[name] = value;
    for (const auto& [part, seconds] : timed_parts()) run["seconds"][part] = seconds;
    run["notes"] = printable_list(logged_notes());
    run["warnings"] = printable_list(logged_warnings());
    run["artifact"] = state_->written_hash;
    for (const auto& input : state_->inputs) run["inputs"][input.role] = input.hash;
    write_file_atomically(state_->run_file(), run.dump(2) + "\n");
}

}  // namespace varimap
