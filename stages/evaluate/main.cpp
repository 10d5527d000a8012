#include <fmt/format.h>

#include "stages/evaluate/evaluate.h"
#include "varimap/core/counted.h"
#include "varimap/stage/stage_main.h"

using namespace varimap;

int main(int argc, char** argv) {
    EvaluateRequest request;
    Stage stage("evaluate", "Geodesic error of a map against known correspondences");
    stage.parameters([&](ParameterList& list) { request.describe(list); });
    const auto& target_path = stage.input("target-mesh", "mesh the map leads to");
    const auto& map_path = stage.input(
        "map", "table of varimap, or a vertex of the target for each of the source: text, CSV, .npy, .npz");
    const auto& lists = stage.input_list(
        "points",
        "vertices of the source and where they belong on the target, a list for each; or, with "
        "--source-mesh, landmarks in any form: one file of pairs, or two files");
    const auto& source_path = stage.input_option(
        "source-mesh", "mesh the map starts from, to check the source's points and their base");
    const auto& curve_path =
        stage.output_option("curve", "CSV to write: share of the pairs within each error");
    const auto& json = stage.flag("json", "print a JSON object");
    const auto& check = stage.flag(
        "check", "only read the meshes and the points; as map any file will do, there need be none yet");
    return stage.main(argc, argv, [&] {
        request.target_mesh = target_path, request.source_mesh = source_path;
        request.map = map_path, request.points = lists;
        if (check && (!curve_path.empty() || json))
            throw UsageError("--check measures nothing: it goes with neither --curve nor --json");
        if (check) return check_points(request);
        const MapErrors errors = evaluate(request);
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
