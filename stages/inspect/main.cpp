#include <cstdio>

#include "stages/inspect/inspect.h"
#include "varimap/stage/stage_main.h"

namespace {

using namespace varimap;

void check_all(const std::vector<std::string>& files) {
    std::size_t bad = 0;
    ExitCode code = ExitCode::ok;
    for (const auto& file : files) {
        const auto failure = check(file);
        if (!failure) continue;
        std::puts(failure->what());
        if (bad++ == 0) code = failure->code();
    }
    if (bad > 0) throw Error(code, fmt::format("{} of {} files failed the check", bad, files.size()));
}

}  // namespace

int main(int argc, char** argv) {
    Stage stage("inspect", "Shows, checks or exports artifacts");
    const auto& files = stage.input_list("file", "artifacts of any kind");
    const bool& checks = stage.flag("check", "verify the files; one line on stdout for each bad one");
    const bool& trace = stage.flag("trace", "all there is to say: every iteration, and the whole lineage");
    const auto& folder =
        stage.option("export", "folder for the contents of the one file, as .npy, .mtx, .ply and text");
    return stage.main(argc, argv, [&] {
        if (checks && !folder.empty()) throw UsageError("give either --check or --export, not both");
        if (checks) return check_all(files);
        if (!folder.empty() && files.size() != 1) throw UsageError("--export takes exactly one file");
        if (!folder.empty()) return export_contents(files.front(), folder);
        for (const auto& file : files)
            fmt::print("{}", summarise(file, trace ? Extent::all : Extent::screen));
    });
}
