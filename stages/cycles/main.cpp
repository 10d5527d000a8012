#include <fmt/format.h>

#include "stages/cycles/collection.h"
#include "varimap/core/log.h"
#include "varimap/results/map_table.h"
#include "varimap/stage/stage_main.h"

using namespace varimap;

namespace {

/// What was added to a pair's maps, as a table for --initial-map.
void write_composed(Stage& stage, const Collection& all, std::size_t pair, const std::string& folder) {
    const auto surface = [&](int s) { return read_artifact<Surface>(all.sketches[std::size_t(s)]).value; };
    const PairOfMaps& maps = all.pairs[pair];
    stage.write_file(folder + "/" + all.names[pair] + ".csv",
                     to_csv(on_files(maps.maps.back(), surface(maps.source), surface(maps.target))));
}

}  // namespace

int main(int argc, char** argv) {
    Stage stage("cycles", "Which of the maps found for each pair make the loops of a collection close");
    const auto& manifest =
        stage.input("manifest", "JSON of varimap batch: surfaces and pairs with their candidates");
    const auto& folder =
        stage.option("composed", "folder that is there, for NAME.csv: maps that no candidate comes near to");
    return stage.main(argc, argv, [&] {
        Collection all = Collection::read(manifest);
        const Choice first(all.pairs.size(), 0);
        std::vector<std::size_t> candidates;
        for (const PairOfMaps& pair : all.pairs) candidates.push_back(pair.maps.size());
        const Choice choice = choose(all.samples, all.pairs);
        const auto before = measure_loops(all.samples, all.pairs, first);
        const auto after = measure_loops(all.samples, all.pairs, choice);
        int others = 0, composed = 0;
        fmt::print("name,candidate,candidates,loops,closed_before,closed,error_before,error\n");
        for (std::size_t p = 0; p < all.pairs.size(); ++p) {
            const bool is_composed = std::size_t(choice[p]) == candidates[p];
            if (is_composed && !folder.empty()) write_composed(stage, all, p, folder);
            composed += is_composed;
            others += !is_composed && choice[p] != 0;
            fmt::print("{},{},{},{},{},{},{:.5f},{:.5f}\n", all.names[p],
                       is_composed ? "composed" : std::to_string(choice[p] + 1), candidates[p],
                       after[p].count, before[p].closed, after[p].closed, before[p].error, after[p].error);
        }
        log("{} pairs, {} with another candidate than the first, {} with a composed map", all.pairs.size(),
            others, composed);
    });
}
