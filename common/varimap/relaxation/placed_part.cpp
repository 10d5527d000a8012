#include "varimap/relaxation/placed_part.h"

#include <array>
#include <numeric>
#include <vector>

#include "varimap/core/log.h"
#include "varimap/relaxation/face_energy.h"
#include "varimap/relaxation/fold_removal.h"
#include "varimap/relaxation/global_relaxation.h"
#include "varimap/relaxation/local_relaxation.h"
#include "varimap/relaxation/relief_agreement.h"

namespace varimap {

namespace {

/// As in untangling.cpp.
struct Round {
    double regularisation, robustness_factor, fold_visits;
};
constexpr std::array<Round, 2> rounds{{{0.3, 3, 8}, {0.1, 1, 20}}};
constexpr int fold_sweeps = 120;
/// Share of the energy that a step must win to be followed by another.
constexpr double least_gain = 1e-4;

std::vector<int> all_faces(const TriangleMesh& mesh) {
    std::vector<int> faces(std::size_t(mesh.face_count()));
    std::iota(faces.begin(), faces.end(), 0);
    return faces;
}

double strain(const SlidingMap& map, const std::vector<int>& faces, double robustness) {
    const RobustEnergy energy({1, rounds.back().regularisation}, robustness);
    double area = 0;
    for (const int f : faces)
        if (map.is_mapped(f)) area += map.rest(f).area;
    return area > 0 ? total_energy(map, faces, energy) / area : 0;
}

}  // namespace

PlacedPart place_part(const PointMap& images, const TriangleMesh& part, const TriangleMesh& whole,
                      const VertexData<bool>& pinned, const PartPlacing& placing) {
    SlidingMap map(images, part, whole);
    const std::vector<int> faces = all_faces(part);
    map.scale_rest(faces, placing.share);
    const ReliefAgreement relief(map, placing.relief_weight, placing.opposed);
    std::vector<int> free;
    for (int v = 0; v < part.vertex_count(); ++v)
        if (!pinned[v] && map.has_image(v)) free.push_back(v);
    for (const Round& round : rounds) {
        GlobalRelaxation global(map, pinned, placing.relief_weight > 0 ? &relief : nullptr);
        LocalRelaxation local(map, 99);
        const RobustEnergy energy({1, round.regularisation}, round.robustness_factor * placing.robustness);
        int step = 0;
        for (; step < placing.steps; ++step) {
            const double gain = global.step(energy);
            local.sweep(free, energy.energy);
            if (gain < least_gain && step > 3) break;
        }
        FoldRemoval{fold_sweeps, round.fold_visits}(map, pinned);
        log("the part placed in {} steps, strain {:.4f}", step, strain(map, faces, placing.robustness));
    }
    return {map.points(), strain(map, faces, placing.robustness)};
}

}  // namespace varimap
