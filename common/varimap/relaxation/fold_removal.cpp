#include "varimap/relaxation/fold_removal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "varimap/relaxation/face_energy.h"
#include "varimap/relaxation/local_relaxation.h"

namespace varimap {

namespace {

constexpr int patience = 40;    ///< sweeps without fewer folds or a better worst face; swept: 20 to 80
constexpr int polishing = 10;   ///< sweeps once nothing is folded; swept: 5 to 20
constexpr int leap_period = 4;  ///< sweeps; swept: 2 to 8
constexpr double least_regularisation = 1e-4;
constexpr std::array<double, 3> weights{1, 0.2, 0.05};
constexpr std::array<int, 5> rings{3, 6, 12, 24, 48};

/// Vertices that may move to unfold `folded`: those of the faces and of `ring_count` rings around them.
std::vector<int> patch_around(const SlidingMap& map, const std::vector<int>& folded, int ring_count,
                              const VertexData<bool>& fixed) {
    VertexData<bool> inside(map.source().vertex_count());
    std::vector<int> patch, front;
    const auto add_corners = [&](int f, std::vector<int>& to) {
        for (int k = 0; k < 3; ++k) {
            const int v = map.source().faces(f, k);
            if (!inside[v] && map.has_image(v)) to.push_back(v);
            inside[v] = true;
        }
    };
    for (const int f : folded) add_corners(f, front);
    for (int ring = 0; !front.empty(); ++ring) {
        patch.insert(patch.end(), front.begin(), front.end());
        if (ring == ring_count) break;
        std::vector<int> next;
        for (const int v : front)
            for (const int f : map.faces_of_vertex()[v]) add_corners(f, next);
        front.swap(next);
    }
    std::erase_if(patch, [&](int v) { return fixed[v] != 0; });
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

PatchState state_of(const SlidingMap& map, const std::vector<int>& faces, const FoldEnergy& energy) {
    PatchState state;
    for (const int f : faces) {
        const double D = map.image_triangle(f).D;
        state.worst = std::min(state.worst, D);
        state.folded += D <= FoldRemoval::flat_limit;
    }
    state.energy = total_energy(map, faces, energy);
    return state;
}

/// The schedule of foldover-free maps, and its 0.1 (Garanzha et al. 2021): e falls with the energy's
/// progress, never faster than the worst face allows.
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
    const std::vector<int> faces = faces_of(map, patch);
    FoldEnergy energy{weight, 1};
    PatchState best = state_of(map, faces, energy);
    int sweeps = 0, idle = 0, clean = 0;
    while (sweeps < most_sweeps && idle < patience && clean < polishing) {
        const double before = total_energy(map, faces, energy);
        relax.sweep(patch, energy, sweeps % leap_period == leap_period - 1);
        ++sweeps;
        const PatchState now = state_of(map, faces, energy);
        const bool better = now.folded < best.folded || (now.folded == best.folded && now.worst > best.worst);
        idle = better ? 0 : idle + 1;
        clean = now.folded == 0 ? clean + 1 : 0;
        if (better) best = now;
        lower_regularisation(energy, before, now);
    }
    return sweeps;
}

/// Folded faces that can move, ascending.
std::vector<int> folded_faces(const SlidingMap& map, const VertexData<bool>& fixed) {
    std::vector<int> folded;
    for (int f = 0; f < map.source().face_count(); ++f)
        if (marked_corners(map.source(), f, fixed) < 3 && map.is_mapped(f) &&
            map.image_triangle(f).D <= FoldRemoval::flat_limit)
            folded.push_back(f);
    return folded;
}

}  // namespace

int FoldRemoval::operator()(SlidingMap& map, const VertexData<bool>& fixed) const {
    int sweeps = 0;
    double visits = most_visits * double(map.source().vertex_count());
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
