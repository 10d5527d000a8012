#include "stages/remesh/remesh.h"

#include <fmt/format.h>

#include <algorithm>

#include "stages/remesh/quality_json.h"
#include "varimap/core/error.h"
#include "varimap/core/log.h"
#include "varimap/mesh/closest_point.h"

namespace varimap {

namespace {

/// Share of input vertices below which the preprocessed surfaces are untangled first.
constexpr double coarse_input = 0.5;

PointMap on_input(const PointMap& images, const Surface& source, const Surface& target) {
    PointMap map(source.vertex_of_input.size());
    for (std::size_t i = 0; i < map.size(); ++i) {
        const int vertex = source.vertex_of_input[i];
        if (vertex >= 0) map[i] = to_input(target, images[std::size_t(vertex)]);
    }
    return map;
}

/// Per input vertex, what `marks` says of the mesh vertex it became.
std::vector<char> on_input(const std::vector<char>& marks, const Surface& surface) {
    std::vector<char> input(surface.vertex_of_input.size(), 0);
    for (std::size_t i = 0; i < input.size(); ++i)
        if (surface.vertex_of_input[i] >= 0) input[i] = marks[std::size_t(surface.vertex_of_input[i])];
    return input;
}

bool is_coarse(const Surface& surface) {
    return double(surface.input.vertex_count()) < coarse_input * double(surface.mesh.vertex_count());
}

PinnedPair pinned_vertices(const PairRecord& record, const Surface& A, const Surface& B) {
    PinnedPair pinned{std::vector<char>(std::size_t(A.mesh.vertex_count()), 0),
                      std::vector<char>(std::size_t(B.mesh.vertex_count()), 0)};
    if (!record.pins_landmarks()) return pinned;
    for (const auto& [a, b] : record.landmarks)
        pinned.A[std::size_t(a.index)] = pinned.B[std::size_t(b.index)] = 1;
    return pinned;
}

/// Landmarks that are points lie between vertices: none of these is where its image has to be.
PinnedPair with_points(PinnedPair vertices, const PointPairs& points, const PairRecord& record) {
    if (!record.pins_landmarks() || points.empty()) return vertices;
    std::fill(vertices.A.begin(), vertices.A.end(), 0);
    std::fill(vertices.B.begin(), vertices.B.end(), 0);
    vertices.points = points;
    return vertices;
}

/// Points of the inputs as points of the preprocessed meshes.
PointPairs on_meshes(const PointPairs& points, const Surface& A, const Surface& B) {
    if (points.empty()) return {};
    const ClosestPoint on_A(A.mesh), on_B(B.mesh);
    const auto moved = [](const Surface& surface, const SurfacePoint& point, const ClosestPoint& closest) {
        return closest((position(surface.input, point) - surface.centre) * surface.scale).point;
    };
    PointPairs result;
    for (const auto& [a, b] : points) result.emplace_back(moved(A, a, on_A), moved(B, b, on_B));
    return result;
}

void require_on_inputs(const PairRecord& record, const Surface& A, const Surface& B) {
    for (const auto& [a, b] : record.landmark_points)
        if (a.face >= A.input.face_count() || b.face >= B.input.face_count())
            throw ArtifactError(
                "the plan has landmarks on faces that the surfaces lack; rerun varimap-diffuse");
}

void log_untangling(const char* name, const UntanglingReport& report) {
    log("{}: {} triangles reversed ({:.3f}% of the area) before untangling, {} ({:.3f}%) after {} global "
        "steps and {} sweeps; {} of {} strained parts mapped anew; {} triangles cut through features, {} "
        "before",
        name, report.flipped_before, report.flipped_area_percent_before, report.flipped_after,
        report.flipped_area_percent_after, report.global_steps, report.sweeps, report.parts_replaced,
        report.parts_tried, report.disagreeing_after, report.disagreeing_before);
    if (report.mirrored_parts > 0)
        warn(
            "{}: {} parts with {:.1f}% of the area are mirrored and were left as they are; rerun "
            "varimap-diffuse with landmarks on them",
            name, report.mirrored_parts, report.gated_area_percent);
}

}  // namespace

SurfaceMap remesh(const Surface& A, const Surface& B, const SolvedPair& pair, VertexMaps images,
                  const RemeshParams& params) {
    const PairRecord& record = pair.record;
    require_on_inputs(record, A, B);
    MapPair maps{std::move(images.A_to_B), std::move(images.B_to_A)};
    const PinnedPair pinned = pinned_vertices(record, A, B);
    UntanglingOptions options = params.untangling;
    if (is_coarse(A) || is_coarse(B)) {
        const PointPairs points = on_meshes(record.landmark_points, A, B);
        untangle(maps, A.mesh, B.mesh, with_points(pinned, points, record), options);
        options.global_steps = 0;
        options.replace_parts = false;
    }
    const PinnedPair pinned_input =
        with_points({on_input(pinned.A, A), on_input(pinned.B, B)}, record.landmark_points, record);
    MapPair inputs{on_input(maps.A_to_B, A, B), on_input(maps.B_to_A, B, A)};
    const UntanglingReports reports = untangle(inputs, A.input, B.input, pinned_input, options);
    if (options.enabled) {
        log_untangling("source to target", reports.A_to_B);
        log_untangling("target to source", reports.B_to_A);
    }
    SurfaceMap map{std::move(inputs.A_to_B), std::move(inputs.B_to_A), {}};
    map.quality = quality_json(map, A, B, pair, reports);
    if (B.mirrored) map.A_to_B = on_reversed_faces(std::move(map.A_to_B));
    if (A.mirrored) map.B_to_A = on_reversed_faces(std::move(map.B_to_A));
    return map;
}

TriangleMesh cross_remesh(const PointMap& map, const Surface& source, const Surface& target) {
    Points fallback = source.input.vertices;
    fallback.rowwise() -= source.centre.transpose();
    fallback *= source.scale / target.scale;
    fallback.rowwise() += target.centre.transpose();
    const TriangleMesh in_file = target.mirrored ? with_reversed_orientation(target).input : target.input;
    Faces faces = source.input.faces;
    if (target.mirrored) faces.col(1).swap(faces.col(2));
    return {image_positions(map, in_file, fallback), faces};
}

std::string masses_csv(const Surface& surface, const std::vector<int>& samples,
                       const Eigen::VectorXd& transported, const Eigen::VectorXd& mass) {
    std::vector<int> sample_at(std::size_t(surface.mesh.vertex_count()), -1);
    for (std::size_t k = 0; k < samples.size(); ++k) sample_at[std::size_t(samples[k])] = int(k);
    std::string text = "vertex,ratio\n";
    for (std::size_t i = 0; i < surface.vertex_of_input.size(); ++i) {
        const int vertex = surface.vertex_of_input[i], k = vertex < 0 ? -1 : sample_at[std::size_t(vertex)];
        if (k >= 0) text += fmt::format("{},{}\n", i, transported[k] / mass[k]);
    }
    return text;
}

}  // namespace varimap
