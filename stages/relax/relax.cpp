#include "stages/relax/relax.h"

#include <algorithm>

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

SurfaceMap relax(const Surface& A, const Surface& B, const PairRecord& record, VertexMaps images,
                 const RelaxParams& params) {
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
    return {between_input_and_file(std::move(inputs.A_to_B), B),
            between_input_and_file(std::move(inputs.B_to_A), A), reports};
}

}  // namespace varimap
