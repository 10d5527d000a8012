#include "varimap/stage/stage_main.h"

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>
#include <new>
#include <nlohmann/json.hpp>

#include "varimap/stage/command_line.h"
#include "varimap/stage/process.h"

namespace varimap {

struct Stage::State {
    CommandLine line;
    std::string output_kind;
    int output_schema = 0;
    const std::string* output_path = nullptr;
    std::vector<InputRecord> inputs;
    std::map<std::string, double> numbers;
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    bool wrote_artifact = false;

    Header header() const;
    bool is_stale(const std::string& path) const;
    void print_stale() const;
    void require_possible_output() const;
    void log_parameters() const;
};

namespace {

/// stdout may be a closed pipe or a full disk; results that did not arrive are an error.
void print_result(const std::string& text) {
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
        throw IoError("cannot write to standard output");
}

std::string first_line(const std::string& text) {
    return text.substr(0, text.find('\n'));
}

int report(const std::string& stage, ExitCode code, const std::string& message) {
    fmt::print(stderr, "varimap-{}: error: {}\n", stage, first_line(message));
    return int(code);
}

/// The one place where failures become exit codes.
int guarded(const std::string& stage, const std::function<void()>& run) {
    try {
        run();
        return int(ExitCode::ok);
    } catch (const Error& error) {
        return report(stage, error.code(), error.what());
    } catch (const std::bad_alloc&) {
        return report(stage, ExitCode::internal, "out of memory; use a smaller mesh or a machine with more");
    } catch (const std::exception& error) {
        return report(stage, ExitCode::internal, std::string("internal: ") + error.what());
    } catch (...) {
        return report(stage, ExitCode::internal, "internal: unknown exception");
    }
}

}  // namespace

Header Stage::State::header() const {
    Header header;
    header.kind = output_kind;
    header.schema = output_schema;
    header.stage = "varimap-" + line.stage;
    header.version = version();
    header.parameters = line.parameters.resolved();
    header.inputs = inputs;
    return header;
}

bool Stage::State::is_stale(const std::string& path) const {
    try {
        const Header now = header(), then = read_checked(path).first;
        return now.kind != then.kind || now.schema != then.schema || now.stage != then.stage ||
               now.version != then.version || now.parameters != then.parameters;
    } catch (const ArtifactError&) {
        return true;
    }
}

void Stage::State::print_stale() const {
    if (output_schema == 0) return;  // the stage writes no artifact
    for (const auto& path : line.stale)
        if (std::filesystem::exists(path) && is_stale(path)) print_result(path + "\n");
}

/// Found out before the work, not after it.
void Stage::State::require_possible_output() const {
    namespace fs = std::filesystem;
    if (output_path == nullptr) return;
    std::error_code ignored;
    const auto parent = fs::path(*output_path).parent_path();
    const std::string folder = parent.empty() ? "." : parent.string();
    if (!fs::is_directory(folder, ignored))
        throw IoError("cannot write '" + *output_path + "': there is no folder '" + folder + "'");
    if (fs::is_directory(*output_path, ignored))
        throw IoError("cannot write '" + *output_path + "': it is a folder");
    if (::access(folder.c_str(), W_OK) != 0)
        throw IoError("cannot write '" + *output_path + "': no permission to write in '" + folder + "'");
    for (const auto& file : line.positionals)
        if (&file.value != output_path && fs::equivalent(file.value, *output_path, ignored))
            throw UsageError("'" + *output_path + "' is both an input and the output");
}

void Stage::State::log_parameters() const {
    std::string text;
    for (const auto& [name, value] : line.parameters.resolved()) text += fmt::format("{}={} ", name, value);
    log("{}threads={}", text, line.threads);
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
    return state_->line.positionals.emplace_back(CommandLine::Text{role, help, {}}).value;
}

const std::vector<std::string>& Stage::input_list(const std::string& role, const std::string& help) {
    return state_->line.files.emplace(CommandLine::TextList{role, help, 1, 1 << 20, {}}).values;
}

const std::string& Stage::output(const std::string& kind, int schema, const std::string& help) {
    state_->output_kind = kind;
    state_->output_schema = schema;
    // "output-" keeps the name apart from an input of the same kind.
    const std::string& path = input("output-" + kind, help);
    state_->output_path = &path;
    return path;
}

const std::string& Stage::option(const std::string& name, const std::string& help) {
    return state_->line.options.emplace_back(CommandLine::Text{name, help, {}}).value;
}

const std::vector<std::string>& Stage::list_option(const std::string& name, const std::string& help,
                                                   int minimum, int maximum) {
    return state_->line.list_options.emplace_back(CommandLine::TextList{name, help, minimum, maximum, {}})
        .values;
}

const bool& Stage::flag(const std::string& name, const std::string& help) {
    return state_->line.flags.emplace_back(CommandLine::Flag{name, help}).value;
}

int Stage::main(int argc, char** argv, const std::function<void()>& body) {
    return guarded(state_->line.stage, [&] {
        if (const auto text = state_->line.parse(argc, argv)) return print_result(*text);
        if (state_->line.asks_stale) return state_->print_stale();
        state_->require_possible_output();
        state_->log_parameters();
        using tbb::global_control;
        const global_control limit(global_control::max_allowed_parallelism, std::size_t(threads()));
        body();
        if (std::fflush(stdout) != 0) throw IoError("cannot write to standard output");
        write_run_file();
        const Usage used = usage();
        log("done: wall {:.2f} s, CPU {:.2f} s, peak memory {:.0f} MB", used.wall_seconds, used.cpu_seconds,
            used.peak_megabytes);
    });
}

void Stage::record_file(const std::string& role, const std::string& path) {
    record_input({role, "file", file_hash(path)});
}

void Stage::record_input(InputRecord record) {
    state_->inputs.push_back(std::move(record));
}

void Stage::require_lineage(const Header& child, const std::string& child_path, const std::string& role,
                            const Header& parent, const std::string& parent_path) {
    if (child.input_hash(role) == parent.payload_hash) return;
    throw ArtifactError(fmt::format("'{}' was not made from '{}' ({}); rerun {}", child_path, parent_path,
                                    role, child.stage));
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
    Header header = state_->header();
    if (header.kind != kind || header.schema != schema)
        throw std::logic_error("varimap-" + state_->line.stage + " declared another output than a " + kind);
    write_payload(path, std::move(header), payload);
    state_->wrote_artifact = true;
}

void Stage::write_run_file() const {
    if (!state_->wrote_artifact) return;
    const Usage used = usage();
    nlohmann::ordered_json run;
    run["stage"] = state_->line.stage;
    run["wall_seconds"] = used.wall_seconds;
    run["cpu_seconds"] = used.cpu_seconds;
    run["peak_megabytes"] = used.peak_megabytes;
    run["threads"] = threads();
    for (const auto& [name, value] : state_->numbers) run[name] = value;
    write_file_atomically(*state_->output_path + ".run.json", run.dump(2) + "\n");
}

}  // namespace varimap
