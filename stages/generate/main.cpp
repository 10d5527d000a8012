#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>

#include "stages/generate/generate.h"
#include "varimap/core/parse_number.h"
#include "varimap/core/printable.h"
#include "varimap/stage/stage_main.h"

namespace {

using namespace varimap;

unsigned seed_from(const std::string& text) {
    unsigned number = 0;
    if (!parse_number(text, number))
        throw UsageError(fmt::format("seed '{}': give a whole number from 0 to 4294967295", printable(text)));
    return number;
}

}  // namespace

int main(int argc, char** argv) {
    GenerateParams params;
    Stage stage("generate", "Two generated surfaces and the true map between them");
    stage.parameters([&](ParameterList& list) { params.describe(list); });
    const auto& family = stage.word("family", fmt::format("{}", fmt::join(generated_families(), ", ")));
    const auto& seed = stage.word("seed", "a number: the same one gives the same pair");
    const auto& folder = stage.word("folder",
                                    "that is there, for source.ply, target.ply, source.txt, target.txt "
                                    "and landmarks.txt, or with --members for FAMILY_000.ply, "
                                    "FAMILY_000.txt and so on");
    return stage.main(argc, argv, [&] {
        const unsigned number = seed_from(seed);
        if (!std::filesystem::is_directory(folder))
            throw IoError(fmt::format("cannot write into '{}': there is no such folder", folder));
        if (params.members > 0) {
            write_collection(generate_collection(family, number, params), folder);
            fmt::print("{}\n", family);
            return;
        }
        const GeneratedPair pair = generate(family, number, params);
        write_pair(pair, folder);
        fmt::print("{}\n", pair.kind);
    });
}
