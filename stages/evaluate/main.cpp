#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "varimap/core/error.h"
#include "varimap/landmarks/vertex_list.h"
#include "varimap/mesh/io/mesh_file.h"
#include "varimap/mesh/mesh_repair.h"
#include "varimap/results/surface_map.h"
#include "varimap/stage/stage_main.h"
#include "varimap/verification/evaluation.h"

namespace {

using namespace varimap;

std::string as_json(const MapErrors& errors) {
    nlohmann::ordered_json json;
    json["pairs"] = errors.errors.size();
    json["unmapped"] = errors.unmapped;
    json["mean"] = errors.mean();
    json["median"] = errors.median();
    json["maximum"] = errors.maximum();
    json["share_0025"] = errors.share_within(.025);
    json["share_005"] = errors.share_within(.05);
    json["share_01"] = errors.share_within(.1);
    return json.dump(2) + "\n";
}

std::string as_text(const MapErrors& errors) {
    std::string text = "geodesic error in units of sqrt(target area)\n";
    const auto row = [&](const char* name, const std::string& value) {
        text += fmt::format("{:<18}{:>9}\n", name, value);
    };
    row("pairs", fmt::format("{}", errors.errors.size()));
    if (errors.unmapped > 0) row("unmapped", fmt::format("{}", errors.unmapped));
    row("mean", fmt::format("{:.5f}", errors.mean()));
    row("median", fmt::format("{:.5f}", errors.median()));
    row("maximum", fmt::format("{:.5f}", errors.maximum()));
    for (double bound : {.025, .05, .1})
        row(fmt::format("share within {}", bound).c_str(),
            fmt::format("{:.2f} %", 100 * errors.share_within(bound)));
    return text;
}

/// The errors on the repaired target.
MapErrors errors_on(const RepairedMesh& target, const PointMap& map, const std::vector<int>& source_points,
                    std::vector<int> target_points) {
    if (target.link.is_identity()) return map_errors(map, target.mesh, source_points, target_points);
    if (!are_points(map, file_of(target).face_count()))
        throw InputError("the map does not lead to this target: it has other faces");
    for (int& vertex : target_points) vertex = target.link.vertex[size_t(vertex)];
    return map_errors(from_file(map, {}, target.link), target.mesh, source_points, target_points);
}

}  // namespace

int main(int argc, char** argv) {
    RepairOptions options;
    Stage stage("evaluate", "Geodesic error of a map against known correspondences");
    stage.parameters([&](ParameterList& list) { options.describe(list); });
    const auto& target_path = stage.input("target-mesh", "mesh the map leads to");
    const auto& map_path = stage.input("map", "CSV of varimap-remesh, one row per source vertex");
    const auto& source_list = stage.input("source-points", "vertices of the source, one per line");
    const auto& target_list =
        stage.input("target-points", "where they belong: vertices of the target, row by row");
    const auto& base_text = stage.option(
        "index-base",
        "number of a list's first vertex: 0, 1 or auto (coordinates in the list decide, else 0)");
    const auto& source_path = stage.input_option(
        "source-mesh", "mesh the map starts from, to check the source's points and their base");
    const auto& curve_path = stage.option("curve", "CSV to write: share of the pairs within each error");
    const auto& json = stage.flag("json", "print a JSON object");
    return stage.main(argc, argv, [&] {
        const IndexBase base = index_base_from(base_text.empty() ? "auto" : base_text);
        const RepairedMesh target = repaired(read_mesh(target_path), options, target_path);
        std::optional<TriangleMesh> source;
        if (!source_path.empty()) source = read_mesh(source_path);
        const auto source_points = read_vertex_list(source_list, base, source ? &*source : nullptr);
        const auto target_points = read_vertex_list(target_list, base, &file_of(target));
        const MapErrors errors = errors_on(target, read_csv_map(map_path), source_points, target_points);
        if (errors.unmapped > 0)
            warn("{} pairs left out: the map has no image for them, or the target is not mapped there",
                 errors.unmapped);
        if (errors.apart > 0)
            warn("{} images are on other components than they belong to: their errors are straight distances",
                 errors.apart);
        if (!curve_path.empty()) write_file_atomically(curve_path, curve_csv(errors));
        fmt::print("{}", json ? as_json(errors) : as_text(errors));
    });
}
