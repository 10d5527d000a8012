#include "varimap/relaxation/fold_removal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "varimap/relaxation/local_relaxation.h"

namespace varimap {

namespace {

constexpr int patience = 40;   ///< sweeps without fewer folds or a better worst face
constexpr int polishing = 10;  ///< sweeps once nothing is folded
constexpr int leap_period = 4;
constexpr double least_regularisation = 1e-4;
constexpr std::array<double, 3> weights{1, 0.2, 0.05};
constexpr std::array<int, 5> rings{3, 6, 12, 24, 48};

/// Vertices that may move to unfold `folded`: those of the faces and of `rings` rings around them.
std::vector<int> patch_around(const SlidingMap& map, const std::vector<int>& folded, int rings,
                              const std::vector<char>& fixed) {
    std::vector<char> inside(map.points().size(), 0);
    std::vector<int> patch, front;
    const auto add_corners = [&](int f, std::vector<int>& to) {
        for (int k = 0; k < 3; ++k) {
            const int v = map.source().faces(f, k);
            if (!inside[std::size_t(v)] && map.points()[std::size_t(v)].face >= 0) to.push_back(v);
            inside[std::size_t(v)] = 1;
        }
    };
    for (const int f : folded) add_corners(f, front);
    for (int ring = 0; !front.empty(); ++ring) {
        patch.insert(patch.end(), front.begin(), front.end());
        if (ring == rings) break;
        std::vector<int> next;
        for (const int v : front)
            for (const int f : map.faces_of_vertex()[v]) add_corners(f, next);
        front.swap(next);
    }
    std::erase_if(patch, [&](int v) { return fixed[std::size_t(v)] != 0; });
    std::sort(patch.begin(), patch.end());
    return patch;
}

/// Faces with a corner in the patch.
std::vector<int> faces_of(const SlidingMap& map, const std::vector<int>& patch) {
    std::vector<int> faces;
    for (const int v : patch)
        for (const int f : map.faces_of_vertex()[v])
            if (map.is_mapped(f)) faces.push_back(f);
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return faces;
}

struct PatchState {
    double energy = 0, worst = std::numeric_limits<double>::infinity();  ///< worst: least D
    int folded = 0;
};

/// The faces of a patch, as last looked at.
class PatchFaces {
  public:
    PatchFaces(const SlidingMap& map, std::vector<int> faces)
        : map_(map), faces_(std::move(faces)), shape_(faces_.size()) {}

    PatchState look(const FoldEnergy& energy) {
        PatchState state;
        for (std::size_t i = 0; i < faces_.size(); ++i) {
            const ImageTriangle image = map_.image_triangle(faces_[i]);
            shape_[i] = {image.q, image.D};
            state.worst = std::min(state.worst, image.D);
            state.folded += image.D <= FoldRemoval::flat_limit;
        }
        state.energy = energy_as_seen(energy);
        return state;
    }
    double energy_as_seen(const FoldEnergy& energy) const {
        double sum = 0;
        for (std::size_t i = 0; i < faces_.size(); ++i)
            sum += map_.rest(faces_[i]).area * energy.value(shape_[i].q, shape_[i].D);
        return sum;
    }

  private:
    struct Shape {
        double q, D;
    };
    const SlidingMap& map_;
    std::vector<int> faces_;
    std::vector<Shape> shape_;
};

/// The schedule of foldover-free maps: e falls with the energy's progress, never faster than the worst face
/// allows.
void lower_regularisation(FoldEnergy& energy, double before, const PatchState& now) {
    const double s = std::max(0.1, 1 - now.energy / before), e = energy.regularisation;
    double next = e * (1 - s);
    if (now.worst < FoldRemoval::flat_limit) {
        const double mu = (1 - s) * energy.chi(now.worst);
        next = mu > now.worst ? std::min(e, 2 * std::sqrt(mu * (mu - now.worst))) : next;
    }
    energy.regularisation = std::max(next, least_regularisation);
}

/// Sweeps one patch until nothing in it is folded; returns the number of sweeps.
int unfold_patch(SlidingMap& map, LocalRelaxation& relax, std::vector<int> patch, double weight,
                 int most_sweeps) {
    PatchFaces faces(map, faces_of(map, patch));
    FoldEnergy energy{weight, 1};
    PatchState best = faces.look(energy);
    int sweeps = 0, idle = 0, clean = 0;
    while (sweeps < most_sweeps && idle < patience && clean < polishing) {
        const double before = faces.energy_as_seen(energy);
        relax.sweep(patch, energy, sweeps % leap_period == leap_period - 1);
        ++sweeps;
        const PatchState now = faces.look(energy);
        const bool better = now.folded < best.folded || (now.folded == best.folded && now.worst > best.worst);
        idle = better ? 0 : idle + 1;
        clean = now.folded == 0 ? clean + 1 : 0;
        if (better) best = now;
        lower_regularisation(energy, before, now);
    }
    return sweeps;
}

/// Folded faces that can move, ascending.
std::vector<int> folded_faces(const SlidingMap& map, const std::vector<char>& fixed) {
    std::vector<int> folded;
    const auto is_free = [&](int v) { return !fixed[std::size_t(v)]; };
    for (int f = 0; f < map.source().face_count(); ++f) {
        const auto corners = map.source().faces.row(f);
        const bool movable = is_free(corners[0]) || is_free(corners[1]) || is_free(corners[2]);
        if (movable && map.is_mapped(f) && map.image_triangle(f).D <= FoldRemoval::flat_limit)
            folded.push_back(f);
    }
    return folded;
}

}  // namespace

int FoldRemoval::operator()(SlidingMap& map, const std::vector<char>& fixed) const {
    int sweeps = 0;
    double visits = most_visits * double(map.points().size());
    std::uint32_t seed = 1;
    for (const int ring_count : rings)
        for (const double weight : weights) {
            const std::vector<int> folded = folded_faces(map, fixed);
            if (folded.empty()) return sweeps;
            const std::vector<int> patch = patch_around(map, folded, ring_count, fixed);
            const int allowed = int(std::min(double(most_sweeps), visits / double(patch.size() + 1)));
            LocalRelaxation relax(map, seed++ * 2654435761u);
            const int done = unfold_patch(map, relax, patch, weight, allowed);
            sweeps += done;
            visits -= double(done) * double(patch.size());
        }
    return sweeps;
}

}  // namespace varimap
