#include "stages/locate/placement.h"

#include <vector>

#include "varimap/core/index_set.h"
#include "varimap/relaxation/fold_removal.h"
#include "varimap/relaxation/global_relaxation.h"
#include "varimap/relaxation/local_relaxation.h"
#include "varimap/relaxation/movable_vertices.h"
#include "varimap/sliding/face_energy.h"
#include "varimap/untangling/rounds.h"

namespace varimap {

namespace {

/// Share of the energy that a step must win to be followed by another.
constexpr double least_step_gain = 1e-4;

bool has_all_images(const SlidingMap& map) {
    for (const int v : map.source().faces.reshaped())
        if (!map.has_image(v)) return false;
    return true;
}

void relax(SlidingMap& map, const VertexData<bool>& pinned, const ReliefAgreement* relief, const Round& round,
           const PlacingOptions& options) {
    std::vector<int> free = free_vertices(map, pinned, {});
    GlobalRelaxation global(map, pinned, relief);
    LocalRelaxation local(map, 99);
    const RobustEnergy energy({1, round.regularisation}, round.robustness_factor * options.robustness);
    for (int step = 0; step < options.steps; ++step) {
        const double gain = global.step(energy);
        local.sweep(free, energy.energy);
        if (gain < least_step_gain && step > 3) break;
    }
    FoldRemoval{usual_fold_sweeps, round.fold_visits}(map, pinned);
}

}  // namespace

Placement placed(const PointMap& images, const TriangleMesh& part, const TriangleMesh& whole,
                 const VertexData<bool>& pinned, double share, const std::vector<ReliefPair>& reliefs,
                 const PlacingOptions& options) {
    SlidingMap map(images, part, whole);
    if (!has_all_images(map)) return {images};
    map.scale_rest(all_indices(part.face_count()), share);
    const ReliefAgreement relief(map, options.relief_weight * share, reliefs);
    for (const Round& round : relaxation_rounds)
        relax(map, pinned, options.relief_weight > 0 ? &relief : nullptr, round, options);
    const RobustEnergy energy({1, relaxation_rounds.back().regularisation}, options.robustness);
    return {map.points(), mean_energy(map, energy), relief.correlation()};
}

}  // namespace varimap
