#include "varimap/untangling/untwisting.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "varimap/core/index_set.h"
#include "varimap/core/log.h"
#include "varimap/mesh/face_geometry.h"
#include "varimap/quality/quality.h"
#include "varimap/results/choice.h"
#include "varimap/sliding/inverse_map.h"

namespace varimap {

namespace {

/// How far what lies at the faces is to be turned back.
class Turns {
  public:
    Turns(const Tube& tube, const Rings& rings)
        : rings_(rings), place_(rings.all().size(), nowhere), turn_(turns(tube, rings)) {
        for (std::size_t i = 0; i < tube.size(); ++i) place_[std::size_t(tube[i])] = int(i);
        mark_behind(tube);
        leads_around_ =
            std::any_of(place_.begin(), place_.end(), [](int place) { return place == behind; }) &&
            meets_beginning(tube);
        take_out_full_turns();
        before_.resize(turn_.size());
        std::exclusive_scan(turn_.begin(), turn_.end(), before_.begin(), 0.0);
    }
    bool can_be() const { return all_ == 0 || !leads_around_; }
    double at(int f) const {
        const int ring = rings_.of_face(f), place = place_[std::size_t(ring)];
        if (place == behind) return all_;
        if (place == nowhere) return 0;
        const double within = rings_.mean_at(f) / rings_.width() - rings_[ring].band;
        return before_[std::size_t(place)] + std::clamp(within, 0.0, 1.0) * turn_[std::size_t(place)];
    }

  private:
    static constexpr int nowhere = -1, behind = -2;

    /// Rings that hang together with the end of the tube, but over the tube.
    void mark_behind(const Tube& tube) {
        std::vector<int> ahead = rings_[tube.back()].next;
        while (!ahead.empty()) {
            const int ring = ahead.back();
            ahead.pop_back();
            if (place_[std::size_t(ring)] != nowhere) continue;
            place_[std::size_t(ring)] = behind;
            for (const auto* beside : {&rings_[ring].next, &rings_[ring].before})
                ahead.insert(ahead.end(), beside->begin(), beside->end());
        }
    }
    bool meets_beginning(const Tube& tube) const {
        const std::vector<int>& before = rings_[tube.front()].before;
        return std::any_of(before.begin(), before.end(),
                           [&](int ring) { return place_[std::size_t(ring)] == behind; });
    }
    void take_out_full_turns() {
        constexpr double full = 2 * std::numbers::pi, about = full / 4;
        for (const double turn : turn_) all_ += turn;
        const double whole = full * std::round(all_ / full);
        if (whole == 0 || std::abs(all_ - whole) > about) return;
        for (double& turn : turn_) turn *= whole / all_;
        all_ = 0;
    }

    const Rings& rings_;
    std::vector<int> place_;             ///< per ring: in the tube
    std::vector<double> turn_, before_;  ///< per ring of the tube, and summed over those before it
    double all_ = 0;
    bool leads_around_ = false;
};

std::vector<int> marked(const VertexData<bool>& marks) {
    std::vector<int> vertices;
    for (int v = 0; v < marks.size(); ++v)
        if (marks[v]) vertices.push_back(v);
    return vertices;
}

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
double farthest_moved(const Untwisting& found, const std::vector<int>& held, double reference) {
    double farthest = 0;
    for (const int v : held)
        farthest = std::max(
            farthest, std::abs(reference - found.turn[std::size_t(v)]) * found.around[std::size_t(v)].norm());
    return farthest;
}

/// None where nothing is twisted, or where landmarks hold it: one on a side of the tube says how it stays.
std::optional<Steps> steps_out(const PointMap& map, const TriangleMesh& source, const TriangleMesh& target,
                               const VertexData<bool>& is_held, double least_degrees) {
    const std::optional<Untwisting> found = untwisting(map, source, target, least_degrees);
    if (!found) return {};
    const std::vector<int> held = marked(is_held);
    double reference = 0, least = farthest_moved(*found, held, 0);
    for (const int v : held) {
        const double turn = found->turn[std::size_t(v)], moved = farthest_moved(*found, held, turn);
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

/// The maps without the twist of the direction that has more; none if neither has any, of so many degrees.
std::optional<MapPair> without_twist(const MapPair& maps, const TriangleMesh& A, const TriangleMesh& B,
                                     const PinnedPair& pinned, double least_degrees) {
    const VertexData<bool> held_A = held(pinned.A, pinned.points, A, true),
                           held_B = held(pinned.B, pinned.points, B, false);
    const auto there = steps_out(maps.A_to_B, A, B, held_A, least_degrees),
               back = steps_out(maps.B_to_A, B, A, held_B, least_degrees);
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

std::optional<Untwisting> untwisting(const PointMap& map, const TriangleMesh& source,
                                     const TriangleMesh& target, double least) {
    if (source.face_count() == 0) return {};
    const ImageMesh images(map, source, target);
    const Rings rings(images);
    const auto [tube, twist] = most_twisted(rings);
    if (tube.empty() || twist.degrees < least) return {};
    const Turns turns(tube, rings);
    if (!turns.can_be()) return {};
    Untwisting result{twist, std::vector<double>(map.size(), 0), std::vector<Vec3>(map.size(), Vec3::Zero())};
    std::vector<double> weight(map.size(), 0);
    for (int f = 0; f < source.face_count(); ++f) {
        const std::optional<Shear> shear = rings.shear(f);
        if (!shear) continue;
        const double area = face_normal(images.source, f).norm() / 2, turn = turns.at(f);
        const Vec3 around = rings.radius_at(f) * shear->around.normalized();
        for (const int v : source.faces.row(f)) {
            result.turn[std::size_t(v)] += area * turn;
            result.around[std::size_t(v)] += area * around;
            weight[std::size_t(v)] += area;
        }
    }
    for (std::size_t v = 0; v < weight.size(); ++v)
        if (weight[v] > 0) result.turn[v] /= weight[v], result.around[v] /= weight[v];
    return result;
}

UntanglingReports untangle_untwisted(MapPair& maps, const TriangleMesh& A, const TriangleMesh& B,
                                     const PinnedPair& pinned, const UntanglingOptions& options) {
    // What shears much is taken for less than it is twisted by; so rounds follow, for what may be the rest:
    // of a shaft twisted by 360 degrees 98 were left. Half of what is doubted, not swept; a tube that is
    // twisted by as much on purpose keeps it where that strains less.
    constexpr int most_rounds = 3;
    constexpr double rest = doubtful_twist / 2;
    UntanglingReports reports = untangle(maps, A, B, pinned, options);
    for (int round = 0; options.enabled && round < most_rounds; ++round) {
        std::optional<MapPair> other = without_twist(maps, A, B, pinned, round > 0 ? rest : doubtful_twist);
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
