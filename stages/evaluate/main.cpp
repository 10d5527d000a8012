#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "varimap/core/counted.h"
#include "varimap/core/enum_names.h"
#include "varimap/core/error.h"
#include "varimap/landmarks/vertex_list.h"
#include "varimap/mesh_files/mesh_file.h"
#include "varimap/mesh_repair/mesh_repair.h"
#include "varimap/results/correspondence.h"
#include "varimap/results/map_file.h"
#include "varimap/stage/stage_main.h"
#include "varimap/verification/evaluation.h"

namespace {

using namespace varimap;

std::string as_json(const MapErrors& errors) {
    nlohmann::ordered_json json;
    json["pairs"] = errors.errors.size();
    json["unmapped"] = errors.unmapped;
    json["mean"] = errors.mean();
    if (errors.smoothed_mean) json["smoothed_mean"] = *errors.smoothed_mean;
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
    if (errors.smoothed_mean) row("smoothed mean", fmt::format("{:.5f}", *errors.smoothed_mean));
    row("median", fmt::format("{:.5f}", errors.median()));
    row("maximum", fmt::format("{:.5f}", errors.maximum()));
    for (double bound : {.025, .05, .1})
        row(fmt::format("share within {}", bound).c_str(),
            fmt::format("{:.2f} %", 100 * errors.share_within(bound)));
    return text;
}

/// Points of the target's file on its repaired mesh; on faces that were dropped they are nowhere.
PointMap on_repaired(const PointMap& points, const RepairedMesh& target) {
    return target.link.is_identity() ? points : from_file(points, {}, target.link);
}

/// The errors on the repaired target, at vertices. `name`: of the map, for errors.
MapErrors vertex_errors(const RepairedMesh& target, const PointMap& map,
                        const std::vector<std::pair<int, int>>& pairs, const std::string& name) {
    std::vector<int> source_points, target_points;
    for (const auto& [source, there] : pairs) {
        source_points.push_back(source);
        target_points.push_back(target.link.is_identity() ? there : target.link.vertex[size_t(there)]);
    }
    return map_errors(on_repaired(map, target), target.mesh, source_points, target_points, name);
}

LandmarkSpace space_from(const std::string& text) {
    if (text.empty()) return LandmarkSpace::stated;
    const auto names = names_of<LandmarkSpace>();
    const auto found = std::ranges::find(names, text);
    if (found == names.end())
        throw UsageError("landmark space '" + text + "': use stated, as-is, lps or ras");
    return LandmarkSpace(found - names.begin());
}

/// The same at landmarks of any form, which the map carries as points.
MapErrors landmark_errors(const RepairedMesh& target, const PointMap& map, const TriangleMesh& source,
                          const std::vector<std::string>& files, const LandmarkReading& reading,
                          const std::string& name) {
    const Landmarks landmarks = read_landmarks(files, source, file_of(target), reading, Repeats::allow);
    const PointCarrier carry(source, map, file_of(target));
    PointMap images, truths;
    for (const auto& [point, truth] : as_points(landmarks, source, file_of(target)))
        images.push_back(carry(point)), truths.push_back(truth);
    images = on_repaired(images, target), truths = on_repaired(truths, target);
    PointPairs pairs;
    for (std::size_t i = 0; i < images.size(); ++i) pairs.emplace_back(images[i], truths[i]);
    return point_errors(pairs, target.mesh, name);
}

MapErrors errors_of(const RepairedMesh& target, const PointMap& map, const TriangleMesh* source,
                    const std::vector<std::string>& files, const LandmarkReading& reading,
                    const std::string& name) {
    if (files.size() == 2 && !holds_points(files[0]) && !holds_points(files[1]))
        return vertex_errors(
            target, map, read_vertex_pairs(files[0], files[1], reading.base, source, &file_of(target)), name);
    if (source == nullptr)
        throw UsageError(files[0] + ": landmarks that are no lists of vertices need --source-mesh, too");
    return landmark_errors(target, map, *source, files, reading, name);
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
        if (lists.size() > 2)
            throw UsageError(
                "points: give a list for the source and one for the target, or one file of pairs");
        const RepairedMesh target = repaired(read_mesh(target_path), options, target_path);
        std::optional<TriangleMesh> source;
        if (!source_path.empty()) source = read_mesh(source_path);
        const PointMap map =
            read_map_file(map_path, index_base_from(map_base), file_of(target), source ? &*source : nullptr);
        const LandmarkReading reading{space_from(space_text), index_base_from(base_text)};
        const MapErrors errors =
            errors_of(target, map, source ? &*source : nullptr, lists, reading, map_path);
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
