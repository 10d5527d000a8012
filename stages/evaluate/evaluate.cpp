#include "stages/evaluate/evaluate.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "varimap/core/error.h"
#include "varimap/mesh_files/mesh_file.h"
#include "varimap/results/correspondence.h"

namespace varimap {

namespace {

/// Points of the target's file on its repaired mesh; on faces that were dropped they are nowhere.
PointMap on_repaired(const PointMap& points, const RepairedMesh& target) {
    return target.link.is_identity() ? points : from_file(points, {}, target.link);
}

/// Where the map is known, row by row.
struct KnownPoints {
    Landmarks rows;
    bool are_vertices;  ///< of two lists, which need no source; else landmarks of another form
};

void require_points(const std::vector<std::string>& files) {
    if (files.size() > 2)
        throw UsageError("points: give a list for the source and one for the target, or one file of pairs");
}

/// `source`: null where it is not known. `source_count`: of its vertices, 0 where that is not known either.
KnownPoints read_points(const EvaluateRequest& request, const TriangleMesh* source,
                        const TriangleMesh& target, int source_count) {
    const auto& files = request.points;
    if (files.size() == 2 && !holds_points(files[0]) && !holds_points(files[1])) {
        KnownPoints points{{}, true};
        for (const auto& [from, to] :
             read_vertex_pairs(files[0], files[1], request.reading.base, source, &target, source_count))
            points.rows.vertices.emplace_back(InputVertex{from}, InputVertex{to});
        return points;
    }
    if (source == nullptr)
        throw UsageError(files[0] + ": landmarks that are no lists of vertices need --source-mesh, too");
    return {read_landmarks(files, *source, target, request.reading, Repeats::allow), false};
}

std::optional<TriangleMesh> source_of(const EvaluateRequest& request) {
    if (request.source_mesh.empty()) return {};
    return read_mesh(request.source_mesh);
}

/// The errors on the repaired target, at vertices. `name`: of the map, for errors.
MapErrors vertex_errors(const RepairedMesh& target, const PointMap& map,
                        const VertexPairs<InputVertex>& pairs, const std::string& name) {
    std::vector<int> source_points, target_points;
    for (const auto& [source, there] : pairs) {
        source_points.push_back(source.index);
        target_points.push_back(target.link.is_identity() ? there.index
                                                          : target.link.vertex[size_t(there.index)]);
    }
    return map_errors(on_repaired(map, target), target.mesh, source_points, target_points, name);
}

/// The same at landmarks of any form, which the map carries as points.
MapErrors landmark_errors(const RepairedMesh& target, const PointMap& map, const TriangleMesh& source,
                          const Landmarks& landmarks, const std::string& name) {
    const PointCarrier carry(source, map, file_of(target));
    PointMap images, truths;
    for (const auto& [point, truth] : as_points(landmarks, source, file_of(target)))
        images.push_back(carry(point)), truths.push_back(truth);
    images = on_repaired(images, target), truths = on_repaired(truths, target);
    PointPairs pairs;
    for (std::size_t i = 0; i < images.size(); ++i) pairs.emplace_back(images[i], truths[i]);
    return point_errors(pairs, target.mesh, name);
}

}  // namespace

MapErrors evaluate(const EvaluateRequest& request) {
    require_points(request.points);
    const RepairedMesh target = repaired(read_mesh(request.target_mesh), request.repair, request.target_mesh);
    const auto source = source_of(request);
    const TriangleMesh* const known_source = source ? &*source : nullptr;
    const PointMap map = read_map_file(request.map, request.map_base, file_of(target), known_source);
    const KnownPoints points = read_points(request, known_source, file_of(target), int(map.size()));
    if (points.are_vertices) return vertex_errors(target, map, points.rows.vertices, request.map);
    return landmark_errors(target, map, *source, points.rows, request.map);
}

void check_points(const EvaluateRequest& request) {
    require_points(request.points);
    const auto source = source_of(request);
    read_points(request, source ? &*source : nullptr, read_mesh(request.target_mesh), 0);
}

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

}  // namespace varimap
