#include "varimap/relaxation/part_replacement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

#include "varimap/mesh/closest_point.h"
#include "varimap/mesh/mass.h"
#include "varimap/quality/image_mesh.h"
#include "varimap/relaxation/continuation.h"
#include "varimap/relaxation/fold_removal.h"
#include "varimap/relaxation/global_relaxation.h"

namespace varimap {

namespace {

using Marks = std::vector<char>;

constexpr int smoothing = 3;      ///< rounds of averaging of the excess
constexpr double saturation = 1;  ///< excess of one face that counts at most
constexpr int relaxation_steps = 4;
constexpr double relaxed_robustness = 0.3;
constexpr int relaxations =
    2;  ///< of an alternative, so of what it is compared with: or it wins by being relaxed
constexpr int fold_sweeps = 40;
constexpr double fold_visits = 60;     ///< of a part's vertices, in the mean
constexpr double promising = 1.5;      ///< times the energy to beat, after folds were removed once
constexpr double hopeless = 4;         ///< times the energy to beat, before folds are removed
constexpr double largest_part = 0.45;  ///< share of the area; more has no surroundings to continue from
/// Area of the widened part / area of the strained one: where a limb is turned, the strain spreads along it.
constexpr std::array<double, 3> widenings{1.6, 4, 10};
/// Area of the target that an alternative may leave: the most of so many mean vertices' areas, and the least
/// of a share of the part's area and a share of the surface's.
constexpr double lost_vertices = 12, lost_share = 0.5, lost_most = 0.035;
constexpr double cell_radius = 2;  ///< edges of the source
/// Of the other direction, which may be wrong where a part is to be mapped anew.
constexpr double doubt = 0.1;
const FoldEnergy judged_energy{1, 0.1};

double excess(const SlidingMap& map, int f) {
    const ImageTriangle image = map.image_triangle(f);
    return RobustExcess(judged_energy, 0).excess(judged_energy.value(image.q, image.D));
}

/// Excess per face, averaged over its surroundings.
std::vector<double> smoothed_excess(const SlidingMap& map) {
    const TriangleMesh& source = map.source();
    std::vector<double> value(std::size_t(source.face_count()), 0);
    for (int f = 0; f < source.face_count(); ++f)
        if (map.is_mapped(f)) value[std::size_t(f)] = std::min(saturation, excess(map, f));
    for (int round = 0; round < smoothing; ++round) {
        std::vector<double> mean(std::size_t(source.vertex_count()), 0);
        for (int v = 0; v < source.vertex_count(); ++v) {
            double sum = 0, area = 0;
            for (const int f : map.faces_of_vertex()[v]) {
                sum += map.rest(f).area * value[std::size_t(f)];
                area += map.rest(f).area;
            }
            if (area > 0) mean[std::size_t(v)] = sum / area;
        }
        for (int f = 0; f < source.face_count(); ++f) {
            const auto c = source.faces.row(f);
            value[std::size_t(f)] =
                (mean[std::size_t(c[0])] + mean[std::size_t(c[1])] + mean[std::size_t(c[2])]) / 3;
        }
    }
    return value;
}

double area_of(const SlidingMap& map, const std::vector<int>& faces) {
    return std::accumulate(faces.begin(), faces.end(), 0.0,
                           [&](double sum, int f) { return sum + map.rest(f).area; });
}

double area_of(const SlidingMap& map, const Marks& marked) {
    double sum = 0;
    for (std::size_t f = 0; f < marked.size(); ++f)
        if (marked[f]) sum += map.rest(int(f)).area;
    return sum;
}

/// The part grown ring by ring to `area`, then with all it cuts off from the largest rest. As marks of faces.
Marks widened(const SlidingMap& map, const Edges& edges, const std::vector<int>& part, double area) {
    constexpr std::size_t least_rings = 2;
    Marks inside(std::size_t(map.source().face_count()), 0);
    for (const int f : part) inside[std::size_t(f)] = 1;
    std::vector<int> ring = part;
    double grown = area_of(map, part);
    for (std::size_t r = 0; !ring.empty() && (r < least_rings || grown < area); ++r) {
        std::vector<int> next;
        for (const int f : ring)
            for (int k = 0; k < 3; ++k)
                for (const int g : map.faces_of_vertex()[map.source().faces(f, k)])
                    if (!inside[std::size_t(g)]) inside[std::size_t(g)] = 1, next.push_back(g);
        grown += area_of(map, next);
        ring.swap(next);
    }
    Marks outside(inside.size());
    for (std::size_t f = 0; f < inside.size(); ++f) outside[f] = !inside[f];
    const auto rest = face_components(edges, outside);
    const auto largest = std::max_element(rest.begin(), rest.end(), [&](const auto& a, const auto& b) {
        return area_of(map, a) < area_of(map, b);
    });
    for (auto it = rest.begin(); it != rest.end(); ++it)
        if (it != largest)
            for (const int f : *it) inside[std::size_t(f)] = 1;
    return inside;
}

std::vector<double> distances(const GeodesicGraph& graph, const std::vector<int>& sources) {
    std::vector<double> distance(std::size_t(graph.vertex_count()), std::numeric_limits<double>::infinity());
    GeodesicBall(graph).grow(sources, [&](int v, double d) {
        distance[std::size_t(v)] = d;
        return true;
    });
    return distance;
}

int nearest_vertex(const TriangleMesh& mesh, const SurfacePoint& point) {
    int corner;
    point.barycentric.maxCoeff(&corner);
    return mesh.faces(point.face, corner);
}

/// One part under trial.
class Trial {
  public:
    /// inside: faces of the part; its vertices are open, what is relaxed reaches one ring into the
    /// surroundings; constraints: of the whole map; landmarks: those of them that hold while it relaxes.
    /// Leaves the part relaxed: to be followed by a run.
    Trial(SlidingMap& map, const Marks& inside, const Marks& fixed, const PartReplacementOptions& options,
          const std::vector<SoftConstraint>& constraints, const std::vector<SoftConstraint>& landmarks,
          const TargetCells& cells)
        : map_(map),
          cells_(cells),
          options_(options),
          open_(fixed.size(), 1),
          held_(fixed.size(), 1),
          before_(map.points()) {
        const int face_count = map.source().face_count();
        const auto corners = [&](int f) { return map.source().faces.row(f); };
        for (int f = 0; f < face_count; ++f)
            for (int k = 0; k < 3; ++k)
                if (!inside[std::size_t(f)]) open_[std::size_t(corners(f)[k])] = 0;
        const auto any = [&](const Marks& marks, int f) {
            const auto c = corners(f);
            return marks[std::size_t(c[0])] || marks[std::size_t(c[1])] || marks[std::size_t(c[2])];
        };
        for (int f = 0; f < face_count; ++f) {
            if (!any(open_, f)) continue;
            for (int k = 0; k < 3; ++k) held_[std::size_t(corners(f)[k])] = fixed[std::size_t(corners(f)[k])];
        }
        Marks free(held_.size());
        for (std::size_t v = 0; v < free.size(); ++v) free[v] = !held_[v];
        for (int f = 0; f < face_count; ++f)
            if (any(free, f)) faces_.push_back(f);
        for (const SoftConstraint& constraint : constraints)
            if (any(free, constraint.from.face)) constraints_.push_back(constraint);
        for (std::size_t v = 0; v < fixed.size(); ++v)
            if (open_[v] && fixed[v]) landmarks_.push_back(int(v));
        global_ = std::make_unique<GlobalRelaxation>(map, held_);
        global_->set_constraints(landmarks);
        for (int i = 0; i < relaxations; ++i) relax();
        energy_to_beat_ = (1 - options.gain) * energy();
        occupied_before_ = cells_.occupied(map);
        const double area = area_of(map, inside);
        tolerated_loss_ =
            std::max(lost_vertices / double(fixed.size()), std::min(lost_share * area, lost_most));
    }

    const Marks& open() const { return open_; }

    /// Maps the part as proposed; true if that was kept.
    template <class Proposal>
    bool run(const Proposal& propose) {
        propose(open_);
        for (const int v : landmarks_) map_.place(v, before_[std::size_t(v)]);
        relax();
        if (energy() < hopeless * energy_to_beat_) {
            remove_folds();
            relax();
        }
        if (energy() < promising * energy_to_beat_) remove_folds();
        if (energy() < energy_to_beat_ && covers_as_much()) return true;
        for (std::size_t v = 0; v < held_.size(); ++v)
            if ((open_[v] || !held_[v]) && before_[v].face >= 0) map_.place(int(v), before_[v]);
        return false;
    }

  private:
    void relax() {
        for (int step = 0; step < relaxation_steps; ++step) global_->step(judged_energy, relaxed_robustness);
    }
    void remove_folds() {
        const double share = double(std::count(held_.begin(), held_.end(), 0)) / double(held_.size());
        FoldRemoval{fold_sweeps, fold_visits * share}(map_, held_);
    }
    bool covers_as_much() const {
        return cells_.lost_area(occupied_before_, cells_.occupied(map_)) <= tolerated_loss_;
    }
    double energy() const {
        const RobustExcess robust(judged_energy, options_.robustness);
        double sum = 0;
        for (const int f : faces_) {
            if (!map_.is_mapped(f)) continue;
            const ImageTriangle image = map_.image_triangle(f);
            sum += map_.rest(f).area * robust.value(judged_energy.value(image.q, image.D));
        }
        for (const SoftConstraint& constraint : constraints_) sum += value(constraint, map_);
        return sum;
    }

    SlidingMap& map_;
    const TargetCells& cells_;
    const PartReplacementOptions& options_;
    Marks open_, held_;  ///< vertices that are placed anew; that stay while the part is relaxed
    PointMap before_;
    std::vector<int> faces_, landmarks_;
    std::vector<SoftConstraint> constraints_;  ///< of those faces
    std::unique_ptr<GlobalRelaxation> global_;
    double energy_to_beat_ = 0;
    Marks occupied_before_;  ///< cells of the target
    double tolerated_loss_ = 0;
};

}  // namespace

PartReplacement::PartReplacement(SlidingMap& map, const Marks& fixed, const PartReplacementOptions& options,
                                 const std::vector<SoftConstraint>& landmarks)
    : map_(map),
      fixed_(fixed),
      options_(options),
      edges_(find_edges(map.source())),
      source_graph_(map.source()),
      target_graph_(map.target()),
      cells_(map, target_graph_, cell_radius * equilateral_edge(map.source())),
      landmarks_(landmarks),
      rejected_(std::size_t(map.source().face_count()), 0) {}

/// Largest first; without those that were rejected before.
std::vector<std::vector<int>> PartReplacement::strained_parts() const {
    const std::vector<double> strain = smoothed_excess(map_);
    Marks strained(strain.size());
    std::vector<double> sorted = strain;
    std::nth_element(sorted.begin(), sorted.begin() + std::ptrdiff_t(sorted.size() / 2), sorted.end());
    const double limit = std::max(options_.excess, options_.contrast * sorted[sorted.size() / 2]);
    for (std::size_t f = 0; f < strain.size(); ++f) strained[f] = strain[f] > limit;
    auto parts = face_components(edges_, strained);
    std::erase_if(parts, [&](const auto& part) {
        const auto known =
            std::count_if(part.begin(), part.end(), [&](int f) { return rejected_[std::size_t(f)]; });
        return area_of(map_, part) < options_.area || double(known) > 0.8 * double(part.size());
    });
    std::stable_sort(parts.begin(), parts.end(),
                     [&](const auto& a, const auto& b) { return area_of(map_, a) > area_of(map_, b); });
    if (int(parts.size()) > options_.most_parts) parts.resize(std::size_t(options_.most_parts));
    return parts;
}

bool PartReplacement::replace_part(const std::vector<int>& part, const Proposals& proposals) {
    for (const double widening : widenings) {
        const Marks inside = widened(map_, edges_, part, widening * area_of(map_, part));
        const double area = area_of(map_, inside);
        if (area > largest_part) return false;
        Trial trial(map_, inside, fixed_, options_, constraints_, landmarks_, cells_);
        for (const Proposal& propose : proposals(trial.open())) {
            visits_ += double(std::count(trial.open().begin(), trial.open().end(), 1));
            if (!trial.run(propose)) continue;
            ++report_.replaced;
            report_.area_percent += 100 * area;
            return true;
        }
    }
    return false;
}

void PartReplacement::replace_parts(const Proposals& proposals) {
    const double most_visits = options_.most_visits * double(map_.points().size());
    visits_ = 0;
    for (int round = 0; round < options_.rounds; ++round) {
        bool changed = false;
        for (const auto& part : strained_parts()) {
            if (visits_ > most_visits) return;
            ++report_.tried;
            const bool replaced = replace_part(part, proposals);
            for (const int f : part) rejected_[std::size_t(f)] = !replaced;
            changed = changed || replaced;
        }
        if (!changed) return;
    }
}

/// How much further the target reaches beyond the image of the cut than the source beyond the cut.
double PartReplacement::length_ratio(const Marks& open) const {
    std::vector<int> cut, cut_images, other_images;
    for (int v = 0; v < int(open.size()); ++v) {
        if (open[std::size_t(v)] || !map_.has_image(v)) continue;
        bool at_cut = false;
        for (const int f : map_.faces_of_vertex()[v])
            for (int k = 0; k < 3; ++k) at_cut = at_cut || open[std::size_t(map_.source().faces(f, k))];
        if (at_cut) cut.push_back(v);
        (at_cut ? cut_images : other_images)
            .push_back(nearest_vertex(map_.target(), map_.points()[std::size_t(v)]));
    }
    if (cut.empty() || other_images.empty()) return 1;
    const auto from_cut = distances(source_graph_, cut);
    const auto from_image = distances(target_graph_, cut_images),
               from_others = distances(target_graph_, other_images);
    double here = 0, there = 0;
    for (std::size_t v = 0; v < open.size(); ++v)
        if (open[v] && std::isfinite(from_cut[v])) here = std::max(here, from_cut[v]);
    for (std::size_t w = 0; w < from_image.size(); ++w)
        if (from_image[w] < from_others[w] && std::isfinite(from_image[w]))
            there = std::max(there, from_image[w]);
    return here > 0 && there > 0 ? std::clamp(there / here, 0.6, 1.6) : 1;
}

void PartReplacement::judge_by(const PointMap& back, double weight) {
    constraints_ = inverse_constraints(map_, back, weight);
    constraints_.insert(constraints_.end(), landmarks_.begin(), landmarks_.end());
}

void PartReplacement::continue_surroundings(const PointMap& back) {
    judge_by(back, doubt * options_.inverse_weight);
    constexpr double noticeable = 0.03;  ///< difference of scales
    replace_parts([&](const Marks& part) {
        const double ratio = length_ratio(part);
        std::vector<Proposal> proposals;
        if (std::abs(ratio - 1) > noticeable)
            proposals.push_back([&, ratio](const Marks& open) { continue_map(map_, open, ratio); });
        proposals.push_back([&](const Marks& open) { continue_map(map_, open, 1); });
        return proposals;
    });
}

void PartReplacement::adopt_inverse(const PointMap& back, bool whole) {
    judge_by(back, options_.inverse_weight);
    // The target's faces as they lie on the source.
    const ImageMesh images(back, map_.target(), map_.source());
    const ClosestPoint closest(images.image);
    const Points normals = vertex_normals(map_.source());
    const Proposal invert = [&](const Marks& open) {
        for (int v = 0; v < int(open.size()); ++v) {
            if (!open[std::size_t(v)] || !map_.has_image(v)) continue;
            const SurfacePoint point = closest(map_.source().vertex(v), normals.row(v).transpose()).point;
            if (images.is_mapped(point.face)) map_.place(v, point);
        }
    };
    std::fill(rejected_.begin(), rejected_.end(), 0);
    if (whole && Trial(map_, Marks(rejected_.size(), 1), fixed_, options_, constraints_, landmarks_, cells_)
                     .run(invert)) {
        ++report_.replaced;
        report_.area_percent += 100;
    }
    replace_parts([&](const Marks&) { return std::vector<Proposal>{invert}; });
}

}  // namespace varimap
