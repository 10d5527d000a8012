#include "stages/remesh/remesh.h"

#include <tbb/parallel_invoke.h>

#include "common/stage/log.h"
#include "stages/remesh/quality_json.h"

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

/// One direction of a map on its way to the input meshes.
struct Direction {
    const Surface& source;
    const Surface& target;
    PointMap on_mesh;               ///< of the preprocessed surfaces' vertices
    std::vector<char> is_landmark;  ///< per vertex of the preprocessed source
    PointMap on_input = {};
    UntanglingReport report = {};
};

void untangle_direction(Direction& direction, UntanglingOptions options) {
    const Surface &source = direction.source, &target = direction.target;
    const auto inputs = double(source.input.vertex_count());
    const bool is_coarse = inputs < coarse_input * double(source.mesh.vertex_count());
    if (is_coarse && options.enabled)
        untangle(direction.on_mesh, source.mesh, target.mesh, direction.is_landmark, options);
    if (is_coarse) options.global_steps = 0;
    direction.on_input = on_input(direction.on_mesh, source, target);
    std::vector<char> is_landmark(direction.on_input.size(), 0);
    for (std::size_t i = 0; i < is_landmark.size(); ++i)
        if (source.vertex_of_input[i] >= 0)
            is_landmark[i] = direction.is_landmark[std::size_t(source.vertex_of_input[i])];
    direction.report = untangle(direction.on_input, source.input, target.input, is_landmark, options);
}

void log_untangling(const char* name, const UntanglingReport& report) {
    log("{}: {} triangles reversed ({:.3f}% of the area) before untangling, {} ({:.3f}%) after {} global "
        "steps "
        "and {} sweeps",
        name, report.flipped_before, report.flipped_area_percent_before, report.flipped_after,
        report.flipped_area_percent_after, report.global_steps, report.sweeps);
    if (report.mirrored_parts > 0)
        warn(
            "{}: {} parts with {:.1f}% of the area are mirrored and were left as they are; rerun "
            "varimap-diffuse with landmarks on them",
            name, report.mirrored_parts, report.gated_area_percent);
}

}  // namespace

SurfaceMap remesh(const Surface& A, const Surface& B, const Plan& plan, const RemeshParams& params) {
    VertexMaps images = read_out(plan, A, B);
    Direction there{A, B, std::move(images.A_to_B), std::vector<char>(std::size_t(A.mesh.vertex_count()), 0)};
    Direction back{B, A, std::move(images.B_to_A), std::vector<char>(std::size_t(B.mesh.vertex_count()), 0)};
    for (const auto& [a, b] : plan.landmarks)
        there.is_landmark[std::size_t(a)] = back.is_landmark[std::size_t(b)] = 1;
    tbb::parallel_invoke([&] { untangle_direction(there, params.untangling); },
                         [&] { untangle_direction(back, params.untangling); });
    if (params.untangling.enabled) {
        log_untangling("source to target", there.report);
        log_untangling("target to source", back.report);
    }
    SurfaceMap map{std::move(there.on_input), std::move(back.on_input), {}};
    map.quality = quality_json(map, A, B, plan, {there.report, back.report});
    return map;
}

TriangleMesh cross_remesh(const PointMap& map, const Surface& source, const Surface& target) {
    Points fallback = source.input.vertices;
    fallback.rowwise() -= source.centre.transpose();
    fallback *= source.scale / target.scale;
    fallback.rowwise() += target.centre.transpose();
    return {image_positions(map, target.input, fallback), source.input.faces};
}

}  // namespace varimap
