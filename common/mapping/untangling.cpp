#include "common/mapping/untangling.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/mapping/fold_removal.h"
#include "common/mapping/global_relaxation.h"
#include "common/mapping/local_relaxation.h"
#include "common/mapping/normal_agreement.h"
#include "common/mapping/part_replacement.h"
#include "common/mapping/quality.h"
#include "common/stage/log.h"

namespace varimap {

namespace {

/// Two rounds of relaxation and removal of folds.
struct Round {
    double regularisation;     ///< e; where it is large, folds pass through each other
    double robustness_factor;  ///< on the option
};
constexpr std::array<Round, 2> rounds{{{0.3, 3}, {0.1, 1}}};
constexpr double large = 20'000;  ///< vertices from which on fewer global steps are taken
constexpr int least_steps = 2;
constexpr double converged = 1e-5;  ///< share of the energy that a step must win to be followed by another

std::vector<int> free_vertices(const MovingMap& map, const std::vector<char>& fixed) {
    std::vector<int> free;
    for (int v = 0; v < int(fixed.size()); ++v)
        if (!fixed[std::size_t(v)] && map.points()[std::size_t(v)].face >= 0) free.push_back(v);
    return free;
}

/// Global steps, each followed by a local sweep that lets single vertices out of corners.
int relax(MovingMap& map, const std::vector<char>& fixed, const Round& round,
          const UntanglingOptions& options) {
    if (options.global_steps == 0) return 0;
    const FoldEnergy energy{options.area_weight, round.regularisation};
    GlobalRelaxation global(map, fixed);
    LocalRelaxation local(map, 99);
    std::vector<int> vertices = free_vertices(map, fixed);
    // A factorisation takes more than linear time; the first steps are those that matter.
    const double affordable = options.global_steps * large / double(vertices.size() + 1);
    const int most = std::min(options.global_steps, std::max(least_steps, int(affordable)));
    int steps = 0;
    for (; steps < most; ++steps) {
        const double gain = global.step(energy, round.robustness_factor * options.robustness);
        local.sweep(vertices, energy, false);
        if (gain < converged && steps > 2) break;
    }
    return steps;
}

void fix_mirrored_parts(const MovingMap& map, const MirrorGate& gate, std::vector<char>& fixed,
                        UntanglingReport& report) {
    for (const ReversedPatch& patch : reversed_patches(map)) {
        if (!is_mirrored_part(patch, gate)) continue;
        ++report.mirrored_parts;
        report.gated_area_percent += 100 * patch.area;
        for (const int f : patch.faces)
            for (int k = 0; k < 3; ++k) fixed[std::size_t(map.source().faces(f, k))] = 1;
    }
}

}  // namespace

UntanglingReport untangle(PointMap& map, const TriangleMesh& source, const TriangleMesh& target,
                          const std::vector<char>& pinned, const UntanglingOptions& options) {
    UntanglingReport report;
    const Distortion before = measure_distortion(map, source, target);
    report.flipped_before = report.flipped_after = before.flipped_count;
    report.flipped_area_percent_before = report.flipped_area_percent_after = before.flipped_area_percent;
    if (!options.enabled) return report;

    MovingMap moving(map, source, target);
    std::vector<char> fixed = pinned;
    fix_mirrored_parts(moving, options.gate, fixed, report);
    const FoldRemoval remove_folds{options.fold_sweeps};
    for (const Round& round : rounds) {
        report.global_steps += relax(moving, fixed, round, options);
        report.sweeps += remove_folds(moving, fixed);
        if (&round == &rounds[0] && !getenv("NO_PARTS")) {
            for (int k = 0; k < (getenv("ROUNDS") ? atoi(getenv("ROUNDS")) : 3); ++k) {
            const PartReplacementReport parts = replace_strained_parts(moving, pinned, {});
            log("parts: {} tried, {} replaced, {:.2f}%", parts.tried, parts.replaced, parts.area_percent);
            if (!parts.replaced) break;
            }
        }
    }
    if (!getenv("NO_AGREE")) {
        NormalAgreement agreement(moving);
        const auto b = agreement.disagreeing_faces().size();
        const int moves = agreement.improve(fixed);
        log("disagreeing {} before, {} after {} moves", b, agreement.disagreeing_faces().size(), moves);
    }
    const Distortion after = measure_distortion(moving.points(), source, target);
    if (after.flipped_area_percent > before.flipped_area_percent) return report;
    map = moving.points();
    report.flipped_after = after.flipped_count;
    report.flipped_area_percent_after = after.flipped_area_percent;
    return report;
}

}  // namespace varimap
