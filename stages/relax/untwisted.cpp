#include "stages/relax/untwisted.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "varimap/core/log.h"
#include "varimap/quality/quality.h"
#include "varimap/quality/twist.h"
#include "varimap/relaxation/inverse_map.h"
#include "varimap/results/candidate.h"

namespace varimap {

namespace {

/// Vertices of a surface that landmarks hold.
VertexData<bool> held(const VertexData<bool>& pinned, const PointPairs& points, const TriangleMesh& source,
                      bool is_A) {
    VertexData<bool> marks = pinned;
    for (const auto& [a, b] : points) mark_corners(source, (is_A ? a : b).face, marks);
    return marks;
}

/// Per vertex a way along the target that takes a twist out.
struct Steps {
    double degrees;
    std::vector<Vec3> of_vertex;
};

/// How far what is held is moved if the tube stays where it is turned by `reference`.
double farthest_held(const Untwisting& found, const VertexData<bool>& held, double reference) {
    double farthest = 0;
    for (int v = 0; v < held.size(); ++v)
        if (held[v])
            farthest = std::max(farthest, std::abs(reference - found.turn[std::size_t(v)]) *
                                              found.around[std::size_t(v)].norm());
    return farthest;
}

/// None where nothing is twisted, or where landmarks hold it: one on a side of the tube says how it stays.
std::optional<Steps> steps_out(const PointMap& map, const TriangleMesh& source, const TriangleMesh& target,
                               const VertexData<bool>& held) {
    const std::optional<Untwisting> found = untwisting(map, source, target, doubtful_twist);
    if (!found) return {};
    double reference = 0, least = farthest_held(*found, held, 0);
    for (int v = 0; v < source.vertex_count(); ++v) {
        if (!held[v]) continue;
        const double turn = found->turn[std::size_t(v)], moved = farthest_held(*found, held, turn);
        if (moved < least) reference = turn, least = moved;
    }
    // Where landmarks beside the axis are to be moved more, what comes of it is strained more.
    constexpr double little = 0.03;  // units of sqrt(area)
    if (least > little) return {};
    Steps steps{found->twist.degrees, {}};
    for (std::size_t v = 0; v < map.size(); ++v)
        steps.of_vertex.push_back((reference - found->turn[v]) * found->around[v]);
    return steps;
}

PointMap walked(const PointMap& map, const std::vector<Vec3>& steps, const TriangleMesh& source,
                const TriangleMesh& target, const VertexData<bool>& held) {
    SlidingMap sliding(map, source, target);
    for (int v = 0; v < source.vertex_count(); ++v)
        if (!held[v] && sliding.has_image(v)) sliding.move(v, steps[std::size_t(v)]);
    return sliding.points();
}

VertexData<bool> not_marked(VertexData<bool> marks) {
    for (int v = 0; v < marks.size(); ++v) marks[v] = !marks[v];
    return marks;
}

/// The maps without the twist of the direction that has more; none if neither has any.
std::optional<MapPair> untwisted(const MapPair& maps, const TriangleMesh& A, const TriangleMesh& B,
                                 const PinnedPair& pinned) {
    const VertexData<bool> held_A = held(pinned.A, pinned.points, A, true),
                           held_B = held(pinned.B, pinned.points, B, false);
    const auto there = steps_out(maps.A_to_B, A, B, held_A), back = steps_out(maps.B_to_A, B, A, held_B);
    if (!there && !back) return {};
    const bool is_there = !back || (there && there->degrees >= back->degrees);
    log("a tube is twisted by {:.0f} degrees: once more without that", (is_there ? there : back)->degrees);
    MapPair result = maps;
    if (is_there) {
        result.A_to_B = walked(maps.A_to_B, there->of_vertex, A, B, held_A);
        result.B_to_A = laid_by_inverse(maps.B_to_A, result.A_to_B, B, A, not_marked(held_B));
    } else {
        result.B_to_A = walked(maps.B_to_A, back->of_vertex, B, A, held_B);
        result.A_to_B = laid_by_inverse(maps.A_to_B, result.B_to_A, A, B, not_marked(held_A));
    }
    return result;
}

/// Dirichlet energy, geometric mean of both directions.
double strain(const MapPair& maps, const TriangleMesh& A, const TriangleMesh& B) {
    return std::sqrt(measure_distortion(maps.A_to_B, A, B).dirichlet_energy *
                     measure_distortion(maps.B_to_A, B, A).dirichlet_energy);
}

}  // namespace

UntanglingReports untangle_untwisted(MapPair& maps, const TriangleMesh& A, const TriangleMesh& B,
                                     const PinnedPair& pinned, const UntanglingOptions& options) {
    constexpr int most_rounds = 3;  // what shears much is taken for less than it is twisted by
    UntanglingReports reports = untangle(maps, A, B, pinned, options);
    for (int round = 0; options.enabled && round < most_rounds; ++round) {
        std::optional<MapPair> other = untwisted(maps, A, B, pinned);
        if (!other) break;
        const UntanglingReports other_reports = untangle(*other, A, B, pinned, options);
        const double twisted_strain = strain(maps, A, B), other_strain = strain(*other, A, B);
        log("Dirichlet energy {:.4f} with the twist, {:.4f} without", twisted_strain, other_strain);
        if (!(other_strain < twisted_strain)) break;
        maps = std::move(*other);
        reports = other_reports;
    }
    return reports;
}

}  // namespace varimap
