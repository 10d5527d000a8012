#include "varimap/relaxation/fold_removal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "varimap/core/index_set.h"
#include "varimap/core/timing.h"
#include "varimap/relaxation/local_relaxation.h"
#include "varimap/sliding/face_energy.h"

namespace varimap {

namespace {

constexpr int patience = 20;   ///< sweeps without fewer folds or a better worst face; swept: 15 to 80
constexpr int polishing = 10;  ///< sweeps once nothing is folded; swept: 5 to 20
constexpr double least_regularisation = 1e-4;
constexpr std::array<double, 3> weights{1, 0.2, 0.05};
constexpr std::array<int, 5> widening_rings{3, 6, 12, 24, 48};

/// How bad the worst of some faces are.
struct Folds {
    int count = 0;
    double worst = std::numeric_limits<double>::infinity();  ///< least D

    bool better_than(const Folds& other) const {
        return count < other.count || (count == other.count && worst > other.worst);
    }
};

/// Connected vertices that move together, and the faces that have one of them for a corner.
class Patch {
  public:
    Patch(SlidingMap& map, std::vector<int> vertices)
        : map_(map), vertices_(std::move(vertices)), start_(vertices_) {
        for (const int v : vertices_)
            for (const int f : map.faces_of_vertex()[v])
                if (map.is_mapped(f)) faces_.push_back(f);
        make_set(faces_);
        shapes_.resize(faces_.size());
        keep();
        measure();
        best_ = folds_;
    }

    /// Sweeps until nothing is folded, or nothing has become better for a while; leaves the best that was
    /// met. Returns the number of sweeps. `awake`: room for all vertices of the source.
    int unfold(LocalRelaxation& relax, double weight, int most_sweeps, VertexData<bool>& awake);
    int folded() const { return best_.count; }
    std::vector<int> folded_faces() const {
        std::vector<int> folded;
        for (std::size_t i = 0; i < faces_.size(); ++i)
            if (shapes_[i].D <= FoldRemoval::flat_limit) folded.push_back(faces_[i]);
        return folded;
    }

  private:
    struct Shape {
        double q, D;
    };

    void measure() {
        folds_ = {};
        for (std::size_t i = 0; i < faces_.size(); ++i) {
            const ImageTriangle image = map_.image_triangle(faces_[i]);
            shapes_[i] = {image.q, image.D};
            folds_.count += image.D <= FoldRemoval::flat_limit;
            folds_.worst = std::min(folds_.worst, image.D);
        }
    }
    /// What is folded is never left to rest: the energy changes most there from sweep to sweep.
    void wake_folded(VertexData<bool>& awake) const {
        for (const int f : folded_faces()) mark_corners(map_.source(), f, awake);
    }
    double total(const FoldEnergy& energy) const {
        double sum = 0;
        for (std::size_t i = 0; i < faces_.size(); ++i) {
            const RestTriangle& rest = map_.rest(faces_[i]);
            sum += rest.area * density_with_area_weight(energy, rest, shapes_[i].q, shapes_[i].D);
        }
        return sum;
    }
    void keep() { kept_ = map_.points_of(start_); }
    void restore() { map_.place(start_, kept_); }

    SlidingMap& map_;
    std::vector<int> vertices_, start_;  ///< in the order of visits, and of kept_
    std::vector<int> faces_;
    std::vector<Shape> shapes_;
    Folds folds_, best_;
    PointMap kept_;  ///< where the folds were best
};

/// The schedule of foldover-free maps, and its 0.1 (Garanzha et al. 2021): e falls with the energy's
/// progress, never faster than the worst face allows.
void lower_regularisation(FoldEnergy& energy, double before, double now, double worst) {
    const double s = std::max(0.1, 1 - now / before), e = energy.regularisation;
    double next = e * (1 - s);
    if (worst < FoldRemoval::flat_limit) {
        const double mu = (1 - s) * energy.chi(worst);
        next = mu > worst ? std::min(e, 2 * std::sqrt(mu * (mu - worst))) : next;
    }
    energy.regularisation = std::max(next, least_regularisation);
}

int Patch::unfold(LocalRelaxation& relax, double weight, int most_sweeps, VertexData<bool>& awake) {
    for (const int v : vertices_) awake[v] = true;
    FoldEnergy energy{weight, 1};
    int sweeps = 0, idle = 0, clean = 0;
    while (sweeps < most_sweeps && idle < patience && clean < polishing) {
        const double before = total(energy);
        wake_folded(awake);
        relax.sweep_awake(vertices_, energy, awake);
        ++sweeps;
        measure();
        const bool better = folds_.better_than(best_);
        idle = better ? 0 : idle + 1;
        clean = folds_.count == 0 ? clean + 1 : 0;
        if (better || clean > 0) {
            best_ = folds_;
            keep();
        }
        lower_regularisation(energy, before, total(energy), folds_.worst);
    }
    restore();
    measure();
    return sweeps;
}

/// A folded face, and how often in a row its patch was tried in vain.
struct Fold {
    int face, strikes;
};

/// Removes the folds of one map.
class Removal {
  public:
    Removal(SlidingMap& map, const VertexData<bool>& fixed, const FoldRemoval& options)
        : map_(map),
          fixed_(fixed),
          options_(options),
          relax_(map, 2654435761u),
          visits_(options.most_visits * count_used_vertices(map.source())),
          strikes_(map.source().vertex_count(), none),
          awake_(map.source().vertex_count()) {}

    int run(std::vector<Fold> folds) {
        for (const int ring_count : widening_rings) {
            std::vector<Fold> left;
            mark_around(folds, ring_count);
            for (const int v : marked_)
                if (strikes_[v] != none) unfold(component_of(v), left);
            folds.swap(left);
        }
        return sweeps_;
    }

  private:
    static constexpr int none = -1;

    /// Marks the vertices that may move: those of the faces and of `ring_count` rings around them.
    void mark_around(const std::vector<Fold>& folds, int ring_count);
    struct Component {
        std::vector<int> vertices;
        int strikes;
    };
    /// Takes the marks off the vertices connected with v and returns them.
    Component component_of(int v);
    void unfold(Component component, std::vector<Fold>& left);

    SlidingMap& map_;
    const VertexData<bool>& fixed_;
    const FoldRemoval& options_;
    LocalRelaxation relax_;
    double visits_;            ///< that are left
    VertexData<int> strikes_;  ///< of marked vertices
    VertexData<bool> awake_;   ///< of the patch that is unfolded
    std::vector<int> marked_;  ///< ascending
    int sweeps_ = 0;
};

void Removal::mark_around(const std::vector<Fold>& folds, int ring_count) {
    marked_.clear();
    std::vector<int> front, next;
    const auto mark = [&](int f, int strikes) {
        for (int k = 0; k < 3; ++k) {
            const int v = map_.source().faces(f, k);
            if (strikes_[v] != none || fixed_[v] || !map_.has_image(v)) continue;
            strikes_[v] = strikes;
            next.push_back(v);
        }
    };
    for (const Fold& fold : folds) mark(fold.face, fold.strikes);
    for (int ring = 0; ring < ring_count && !next.empty(); ++ring) {
        front.swap(next);
        marked_.insert(marked_.end(), front.begin(), front.end());
        next.clear();
        for (const int v : front)
            for (const int f : map_.faces_of_vertex()[v]) mark(f, strikes_[v]);
    }
    marked_.insert(marked_.end(), next.begin(), next.end());
    std::sort(marked_.begin(), marked_.end());
}

Removal::Component Removal::component_of(int first) {
    Component component{{first}, strikes_[first]};
    strikes_[first] = none;
    auto& vertices = component.vertices;
    for (std::size_t i = 0; i < vertices.size(); ++i)
        for (const int f : map_.faces_of_vertex()[vertices[i]])
            for (int k = 0; k < 3; ++k) {
                const int v = map_.source().faces(f, k);
                if (strikes_[v] == none) continue;
                component.strikes = std::min(component.strikes, strikes_[v]);
                strikes_[v] = none;
                vertices.push_back(v);
            }
    std::sort(vertices.begin(), vertices.end());
    return component;
}

void Removal::unfold(Component component, std::vector<Fold>& left) {
    const double size = double(component.vertices.size());
    Patch patch(map_, std::move(component.vertices));
    int strikes = component.strikes;
    for (const double weight : weights) {
        if (patch.folded() == 0 || strikes >= options_.strikes || visits_ < size) break;
        const int before = patch.folded();
        const int allowed = int(std::min(double(options_.most_sweeps), visits_ / size));
        const int sweeps = patch.unfold(relax_, weight, allowed, awake_);
        sweeps_ += sweeps;
        visits_ -= sweeps * size;
        strikes = patch.folded() < before ? 0 : strikes + 1;
    }
    if (strikes >= options_.strikes) return;
    for (const int f : patch.folded_faces()) left.push_back({f, strikes});
}

/// Folded faces that can move, ascending.
std::vector<Fold> folds_of(const SlidingMap& map, const VertexData<bool>& fixed) {
    std::vector<Fold> folds;
    for (int f = 0; f < map.source().face_count(); ++f)
        if (marked_corners(map.source(), f, fixed) < 3 && map.is_mapped(f) &&
            map.image_triangle(f).D <= FoldRemoval::flat_limit)
            folds.push_back({f, 0});
    return folds;
}

}  // namespace

int FoldRemoval::operator()(SlidingMap& map, const VertexData<bool>& fixed) const {
    const Timer timer("removal of folds");
    std::vector<Fold> folds = folds_of(map, fixed);
    return folds.empty() ? 0 : Removal(map, fixed, *this).run(std::move(folds));
}

}  // namespace varimap
