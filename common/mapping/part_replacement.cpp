#include "common/mapping/part_replacement.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "common/mapping/continuation.h"
#include "common/mapping/fold_removal.h"
#include "common/mapping/global_relaxation.h"
#include "common/mapping/local_relaxation.h"

namespace varimap {

namespace {

using Marks = std::vector<char>;

constexpr int smoothing = 3;       ///< rounds of averaging of the excess
constexpr double saturation = 1;   ///< excess of one face that counts at most
constexpr int relaxation_steps = 4;
constexpr int fold_sweeps = 60;
constexpr double hopeless = 2;  ///< times the energy to beat, before folds are removed
constexpr double largest_part = 0.45;  ///< share of the area; more has no surroundings to continue from
/// Area of the widened part / area of the strained one: where a limb is turned, the strain spreads along it.
constexpr std::array<double, 3> widenings{1.6, 4, 10};
const FoldEnergy judged_energy{1, 0.1};

double excess(const MovingMap& map, int f) {
    const Chord chord = map.chord(f);
    return RobustExcess(judged_energy, 0).excess(judged_energy.value(chord.q, chord.D));
}

/// Excess per face, averaged over its surroundings.
std::vector<double> smoothed_excess(const MovingMap& map) {
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

/// Connected sets (over edges) of the marked faces.
std::vector<std::vector<int>> components(const Edges& edges, Marks marked) {
    std::vector<std::vector<int>> parts;
    for (int seed = 0; seed < int(marked.size()); ++seed) {
        if (!marked[std::size_t(seed)]) continue;
        std::vector<int> part{seed};
        marked[std::size_t(seed)] = 0;
        for (std::size_t i = 0; i < part.size(); ++i)
            for (int k = 0; k < 3; ++k)
                for (const int side : edges.sides[edges.of_side[std::size_t(3 * part[i] + k)]])
                    if (char& mark = marked[std::size_t(side / 3)]; mark) {
                        mark = 0;
                        part.push_back(side / 3);
                    }
        parts.push_back(std::move(part));
    }
    return parts;
}

double area_of(const MovingMap& map, const std::vector<int>& faces) {
    return std::accumulate(faces.begin(), faces.end(), 0.0,
                           [&](double sum, int f) { return sum + map.rest(f).area; });
}

/// The part grown ring by ring to `area`, then with all it cuts off from the largest rest. As marks of faces.
Marks widened(const MovingMap& map, const Edges& edges, const std::vector<int>& part, double area) {
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
    auto rest = components(edges, outside);
    const auto largest = std::max_element(rest.begin(), rest.end(), [&](const auto& a, const auto& b) {
        return area_of(map, a) < area_of(map, b);
    });
    for (auto it = rest.begin(); it != rest.end(); ++it)
        if (it != largest)
            for (const int f : *it) inside[std::size_t(f)] = 1;
    return inside;
}

/// One part under trial.
class Trial {
  public:
    Trial(MovingMap& map, const Marks& inside, const Marks& fixed, const PartReplacementOptions& options)
        : map_(map), options_(options), open_(fixed.size(), 1), held_(fixed.size(), 1) {
        for (int f = 0; f < map.source().face_count(); ++f)
            for (int k = 0; k < 3; ++k)
                if (!inside[std::size_t(f)]) open_[std::size_t(map.source().faces(f, k))] = 0;
        // What is relaxed reaches one ring into the surroundings.
        for (int f = 0; f < map.source().face_count(); ++f) {
            const auto c = map.source().faces.row(f);
            if (!open_[std::size_t(c[0])] && !open_[std::size_t(c[1])] && !open_[std::size_t(c[2])]) continue;
            area_ += inside[std::size_t(f)] ? map.rest(f).area : 0;
            for (int k = 0; k < 3; ++k) held_[std::size_t(c[k])] = fixed[std::size_t(c[k])];
        }
        for (int f = 0; f < map.source().face_count(); ++f) {
            const auto c = map.source().faces.row(f);
            if (!held_[std::size_t(c[0])] || !held_[std::size_t(c[1])] || !held_[std::size_t(c[2])])
                faces_.push_back(f);
        }
        for (std::size_t v = 0; v < fixed.size(); ++v)
            if (open_[v] && fixed[v]) landmarks_.push_back(int(v));
    }

    double area() const { return area_; }

    /// Maps the part anew; true if that was kept.
    bool run() {
        const PointMap before = map_.points();
        relax();
        const double least = (1 - options_.gain) * energy();
        continue_map(map_, open_);
        for (const int v : landmarks_) map_.place(v, before[std::size_t(v)]);
        relax();
        if (energy() < hopeless * least) {
            FoldRemoval{fold_sweeps}(map_, held_);
            relax();
            FoldRemoval{fold_sweeps}(map_, held_);
        }
        if (getenv("DEBUG_PARTS")) { Vec3 c = Vec3::Zero(); int n = 0; for (std::size_t v = 0; v < open_.size(); ++v) if (open_[v]) c += map_.source().vertex(int(v)), ++n; c /= n; fprintf(stderr, "part area %.4f n %d at %.2f %.2f %.2f: %.5g -> %.5g\n", area_, n, c.x(), c.y(), c.z(), least, energy()); }
        if (energy() < least) return true;
        for (std::size_t v = 0; v < held_.size(); ++v)
            if ((open_[v] || !held_[v]) && before[v].face >= 0) map_.place(int(v), before[v]);
        return false;
    }

  private:
    void relax() {
        GlobalRelaxation global(map_, held_);
        for (int step = 0; step < relaxation_steps; ++step) global.step(judged_energy, options_.robustness);
    }
    double energy() const {
        const RobustExcess robust(judged_energy, options_.robustness);
        double sum = 0;
        for (const int f : faces_)
            if (map_.is_mapped(f)) {
                const Chord chord = map_.chord(f);
                sum += map_.rest(f).area * robust.value(judged_energy.value(chord.q, chord.D));
            }
        return sum;
    }

    MovingMap& map_;
    const PartReplacementOptions& options_;
    Marks open_, held_;  ///< vertices that are placed anew; that stay while the part is relaxed
    std::vector<int> faces_, landmarks_;
    double area_ = 0;
};

}  // namespace

PartReplacementReport replace_strained_parts(MovingMap& map, const Marks& fixed,
                                             const PartReplacementOptions& options) {
    PartReplacementReport report;
    const Edges edges = find_edges(map.source());
    const std::vector<double> strain = smoothed_excess(map);
    Marks strained(strain.size());
    for (std::size_t f = 0; f < strain.size(); ++f) strained[f] = strain[f] > options.excess;
    auto parts = components(edges, strained);
    std::erase_if(parts, [&](const auto& part) { return area_of(map, part) < options.area; });
    std::stable_sort(parts.begin(), parts.end(),
                     [&](const auto& a, const auto& b) { return area_of(map, a) > area_of(map, b); });
    if (int(parts.size()) > options.most_parts) parts.resize(std::size_t(options.most_parts));
    for (const auto& part : parts) {
        ++report.tried;
        for (const double widening : widenings) {
            Trial trial(map, widened(map, edges, part, widening * area_of(map, part)), fixed, options);
            if (trial.area() > largest_part || !trial.run()) continue;
            ++report.replaced;
            report.area_percent += 100 * trial.area();
            break;
        }
    }
    return report;
}

}  // namespace varimap
