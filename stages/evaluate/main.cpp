#include <fmt/format.h>

#include <algorithm>

#include "stages/evaluate/evaluate.h"
#include "varimap/core/counted.h"
#include "varimap/core/enum_names.h"
#include "varimap/core/error.h"
#include "varimap/stage/stage_main.h"

namespace {

using namespace varimap;

LandmarkSpace space_from(const std::string& text) {
    if (text.empty()) return LandmarkSpace::stated;
    const auto names = names_of<LandmarkSpace>();
    const auto found = std::ranges::find(names, text);
    if (found == names.end())
        throw UsageError("landmark space '" + text + "': use stated, as-is, lps or ras");
    return LandmarkSpace(found - names.begin());
}

}  // namespace

int main(int argc, char** argv) {
    RepairOptions options;
    Stage stage("evaluate", "Geodesic error of a map against known correspondences");
    stage.parameters([&](ParameterList& list) { options.describe(list); });
    const auto& target_path = stage.input("target-mesh", "mesh the map leads to");
    const auto& map_path = stage.input(
        "map", "table of varimap, or a vertex of the target for each of the source: text, CSV, .npy, .npz");
    const auto& lists = stage.input_list(
        "points",
        "vertices of the source and where they belong on the target, a list for each; or, with "
        "--source-mesh, landmarks in any form: one file of pairs, or two files");
    const auto& base_text = stage.option(
        "index-base",
        "number of a list's first vertex: 0, 1 or auto (coordinates in the list decide, else 0)");
    const auto& space_text =
        stage.option("landmark-space",
                     "axes of points: stated by their file (default), as-is (those of the mesh), lps or ras");
    const auto& map_base =
        stage.option("map-base", "number of the first vertex in a vertex-to-vertex map: 0, 1 or auto");
    const auto& source_path = stage.input_option(
        "source-mesh", "mesh the map starts from, to check the source's points and their base");
    const auto& curve_path =
        stage.output_option("curve", "CSV to write: share of the pairs within each error");
    const auto& json = stage.flag("json", "print a JSON object");
    return stage.main(argc, argv, [&] {
        const LandmarkReading reading{space_from(space_text), index_base_from(base_text)};
        const MapErrors errors = evaluate(
            {target_path, map_path, lists, source_path, options, index_base_from(map_base), reading});
        if (errors.unmapped > 0)
            warn("{} left out: the map has no image there, or the target is not mapped",
                 counted(errors.unmapped, "pair", "pairs"));
        if (errors.apart > 0)
            warn("{}: the error is the straight distance there",
                 counted(errors.apart, "image is on another component than it should be",
                         "images are on other components than they should be"));
        if (!curve_path.empty()) stage.write_file(curve_path, curve_csv(errors));
        fmt::print("{}", json ? as_json(errors) : as_text(errors));
    });
}
