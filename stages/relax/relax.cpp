#include "stages/relax/relax.h"

#include <fmt/format.h>
#include <tbb/parallel_invoke.h>

#include <optional>
#include <string>

#include "stages/relax/prolongation.h"
#include "varimap/core/counted.h"
#include "varimap/core/log.h"
#include "varimap/mesh/topology.h"
#include "varimap/spectral/local_shape.h"
#include "varimap/untangling/untwisting.h"

namespace varimap {

namespace {

/// Share of input vertices below which the preprocessed surfaces are untangled first.
constexpr double coarse_input = 0.5;
/// Over a map that was carried over from the meshes to the inputs. Where these are far apart the last of the
/// levels between is as fine, and one sweep leaves as few triangles reversed; where none lies between, maps
/// of unlike shapes lose half a percent of coverage with one.
constexpr int fine_sweeps = 3, fine_sweeps_after_levels = 1;
/// Its folds are small and soon removed, or none of its own but where the map is torn. On a pair of skulls
/// 8 leave as many triangles reversed.
constexpr double fine_fold_visits = 3;

/// Whether mesh and input differ in resolution, so that the map is untangled on the meshes first.
bool is_apart(const Surface& surface) {
    return surface.input_face.empty() ||
           count_used_vertices(surface.input) < coarse_input * surface.mesh.vertex_count();
}

/// Whether what is wrong on the mesh becomes a tangle on the input. Where the input has up to 5 times the
/// vertices, maps whose vertices were moved one by one on the meshes end with a tenth fewer reversed faces;
/// where it has 50 times, with 70% more.
bool is_far_apart(const Surface& surface) {
    constexpr int far = 10;
    return count_used_vertices(surface.input) > far * surface.mesh.vertex_count();
}

PinnedPair none_pinned(const TriangleMesh& A, const TriangleMesh& B) {
    return {VertexData<bool>(A.vertex_count()), VertexData<bool>(B.vertex_count())};
}

/// Landmarks on the surfaces' meshes; those between vertices are drawn onto each other.
PinnedPair pinned_on_meshes(const PairRecord& record, const Surface& A, const Surface& B) {
    PinnedPair pinned = none_pinned(A.mesh, B.mesh);
    if (!record.pins_landmarks()) return pinned;
    if (record.landmark_points.empty()) {
        for (const auto& [a, b] : record.landmarks) pinned.A[a.index] = pinned.B[b.index] = true;
        return pinned;
    }
    const MeshLocator on_A(A), on_B(B);
    for (const auto& [a, b] : record.landmark_points) pinned.points.emplace_back(on_A(a), on_B(b));
    return pinned;
}

/// Landmarks on the inputs: vertices that are pinned, with their images, and points that are drawn.
PinnedPair pin_on_inputs(const PairRecord& record, const Surface& A, const Surface& B, MapPair& maps) {
    PinnedPair pinned = none_pinned(A.input, B.input);
    if (!record.pins_landmarks()) return pinned;
    const PointMap at_A = points_at_vertices(A.input), at_B = points_at_vertices(B.input);
    for (const auto& [from, to] : landmarks_on_inputs(record, A, B)) {
        const int a = vertex_of(A.input, from), b = vertex_of(B.input, to);
        if (a < 0 || b < 0) {
            pinned.points.emplace_back(from, to);
            continue;
        }
        maps.A_to_B[std::size_t(a)] = at_B[std::size_t(b)];
        maps.B_to_A[std::size_t(b)] = at_A[std::size_t(a)];
        pinned.A[a] = pinned.B[b] = true;
    }
    return pinned;
}

PointMap on_input(const PointMap& images, const Surface& source, const Surface& target,
                  const VertexData<bool>& pinned, const std::vector<SurfacePoint>& landmarks,
                  const UntanglingOptions& options) {
    Prolongation map(images, source, target);
    const bool is_coarse = source.input_face.empty();
    if (is_coarse && options.enabled) map.relax_between(pinned, landmarks, options);
    return map.on_input();
}

/// The maps carried over from the meshes to the inputs, and relaxed on the way if that is enabled.
MapPair on_inputs(const MapPair& maps, const Surface& A, const Surface& B, const PinnedPair& pinned,
                  const UntanglingOptions& options) {
    std::vector<SurfacePoint> points_A, points_B;
    for (const auto& [a, b] : pinned.points) {
        points_A.push_back(a);
        points_B.push_back(b);
    }
    MapPair inputs;
    tbb::parallel_invoke([&] { inputs.A_to_B = on_input(maps.A_to_B, A, B, pinned.A, points_A, options); },
                         [&] { inputs.B_to_A = on_input(maps.B_to_A, B, A, pinned.B, points_B, options); });
    return inputs;
}

void log_untangling(const std::string& name, const UntanglingReport& report) {
    log("{}: {} triangles reversed ({:.3f}% of the area) before untangling, {} ({:.3f}%) after {} global "
        "steps and {} sweeps; {} of {} strained parts mapped anew; {} triangles cut through features, {} "
        "before",
        name, report.flipped_before, report.flipped_area_percent_before, report.flipped_after,
        report.flipped_area_percent_after, report.global_steps, report.sweeps, report.parts_replaced,
        report.parts_tried, report.disagreeing_after, report.disagreeing_before);
}

void log_untangling(const char* which, const UntanglingReports& reports) {
    log_untangling(fmt::format("{}, source to target", which), reports.A_to_B);
    log_untangling(fmt::format("{}, target to source", which), reports.B_to_A);
}

/// What was done on the meshes and then on the inputs, as one.
UntanglingReport joined(const UntanglingReport& meshes, UntanglingReport inputs) {
    UntanglingReport report = meshes;
    report.flipped_after = inputs.flipped_after;
    report.flipped_area_percent_after = inputs.flipped_area_percent_after;
    report.global_steps += inputs.global_steps;
    report.sweeps += inputs.sweeps;
    report.disagreeing_after = inputs.disagreeing_after;
    report.mirrored_parts = inputs.mirrored_parts;
    report.gated_area_percent = inputs.gated_area_percent;
    return report;
}

void warn_of_mirrored_parts(const char* name, const UntanglingReport& report) {
    if (report.mirrored_parts > 0)
        warn(
            "{}: mirrored are {} with {:.1f}% of the area, left as they are; give landmarks there "
            "(--landmarks)",
            name, counted(report.mirrored_parts, "part", "parts"), report.gated_area_percent);
}

}  // namespace

void warn_of_mirrored_parts(const SurfaceMap& map) {
    warn_of_mirrored_parts("source to target", map.untangling.A_to_B);
    warn_of_mirrored_parts("target to source", map.untangling.B_to_A);
}

SurfaceMap relax(const Surface& A, const Surface& B, const PairRecord& record, MapPair maps,
                 double area_bound, const RelaxParams& params) {
    UntanglingOptions options = params.untangling;
    options.opposed = PairHandedness(A, B).are_opposite();
    if (params.keep_area_bound) options.area_bound = area_bound;
    const PinnedPair landmarks = pinned_on_meshes(record, A, B);
    std::optional<UntanglingReports> on_meshes;
    if (is_apart(A) || is_apart(B)) {
        const bool far = is_far_apart(A) || is_far_apart(B);
        UntanglingOptions coarse_options = options;
        if (far) coarse_options.centre_stars = false;
        // Once: the inputs settle in it again. On those that are far finer than their meshes it takes a fifth
        // of the time, and local sweeps hardly win anything.
        coarse_options.restore_bound = far;
        options.restore_bound = !far;
        coarse_options.repair_again = false;  // dearer than on the inputs, for hardly fewer faults
        on_meshes = untangle_untwisted(maps, A.mesh, B.mesh, landmarks, coarse_options);
        if (options.enabled) log_untangling("on the meshes", *on_meshes);
        options.global_steps = 0;
        options.local_sweeps = far ? fine_sweeps_after_levels : fine_sweeps;
        options.most_fold_visits = fine_fold_visits;
        options.replace_parts = false;
    }
    MapPair inputs = on_inputs(maps, A, B, landmarks, options);
    const PinnedPair pinned = pin_on_inputs(record, A, B, inputs);
    UntanglingReports reports = on_meshes ? untangle(inputs, A.input, B.input, pinned, options)
                                          : untangle_untwisted(inputs, A.input, B.input, pinned, options);
    if (options.enabled) log_untangling("on the inputs", reports);
    if (on_meshes)
        reports = {joined(on_meshes->A_to_B, reports.A_to_B), joined(on_meshes->B_to_A, reports.B_to_A)};
    return {to_file(std::move(inputs.A_to_B), A, B), to_file(std::move(inputs.B_to_A), B, A), reports};
}

}  // namespace varimap
