#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "stages/inspect/inspect.h"
#include "varimap/stage/stage_main.h"

namespace {

using namespace varimap;

/// What a shell leaves of a pattern where there is no such file.
bool is_unmatched_pattern(const std::string& name) {
    std::error_code ignored;
    return name.find_first_of("*?[") != std::string::npos && !std::filesystem::exists(name, ignored);
}

void check_all(const std::vector<std::string>& names) {
    std::size_t checked = 0, bad = 0;
    for (const auto& name : names) {
        if (is_unmatched_pattern(name)) {
            log("no file matches {}", name);
            continue;
        }
        ++checked;
        const auto failure = check(name);
        if (!failure) continue;
        ++bad;
        std::puts(failure->what());
    }
    if (checked == 0) throw IoError("nothing was checked: no file matches " + names.front());
    if (bad > 0) throw ArtifactError(fmt::format("{} of {} files failed the check", bad, checked));
}

void print_hashes(const std::vector<std::string>& names) {
    for (const auto& name : names) fmt::print("{}  {}\n", file_hash(name), name);
}

}  // namespace

int main(int argc, char** argv) {
    Stage stage("inspect", "Shows, checks or exports artifacts");
    const auto& files = stage.word_list("file", "artifacts of any kind");
    const bool& checks = stage.flag("check", "verify the files; one line on stdout for each bad one");
    const bool& trace = stage.flag("trace", "all there is to say: every iteration, and the whole lineage");
    const bool& hashes =
        stage.flag("hash",
                   "of files of any kind, meshes too, the hash of their content by which results name "
                   "what they were made from, and their names");
    const auto& folder =
        stage.option("export", "folder for the contents of the one file, as .npy, .mtx, .ply and text");
    return stage.main(argc, argv, [&] {
        if (checks && !folder.empty()) throw UsageError("give either --check or --export, not both");
        if (trace && (checks || !folder.empty()))
            throw UsageError("--trace is about what is shown: with --check and --export nothing is");
        if (hashes && (checks || trace || !folder.empty()))
            throw UsageError("--hash goes with none of --check, --trace and --export");
        if (hashes) return print_hashes(files);
        if (checks) return check_all(files);
        if (!folder.empty() && files.size() != 1) throw UsageError("--export takes exactly one file");
        if (!folder.empty()) return export_contents(files.front(), folder);
        for (const auto& file : files)
            fmt::print("{}", summarise(file, trace ? Detail::all : Detail::screen));
    });
}
