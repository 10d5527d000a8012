#include "common/mapping/untangling.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <memory>

#include "common/mapping/feature_agreement.h"
#include "common/mapping/fold_removal.h"
#include "common/mapping/global_relaxation.h"
#include "common/mapping/local_relaxation.h"
#include "common/mapping/normal_agreement.h"
#include "common/mapping/quality.h"

namespace varimap {

namespace {

/// Two rounds of relaxation and removal of folds.
struct Round {
    double regularisation;     ///< e; where it is large, folds pass through each other
    double robustness_factor;  ///< on the option
    double fold_visits;        ///< bounds the removal of folds (fold_removal.h)
};
/// The first leaves crumpled parts to their replacement.
constexpr std::array<Round, 2> rounds{{{0.3, 3, 30}, {0.1, 1, 150}}};
constexpr int reconciliations = 2;
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
int relax(MovingMap& map, const std::vector<char>& fixed, const FeatureAgreement* features,
          const Round& round, const UntanglingOptions& options) {
    if (options.global_steps == 0) return 0;
    const FoldEnergy energy{options.area_weight, round.regularisation};
    GlobalRelaxation global(map, fixed, features);
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

/// Vertices that stay: the pinned ones and those of mirrored parts.
std::vector<char> stay(const MovingMap& map, const std::vector<char>& pinned, const MirrorGate& gate,
                       UntanglingReport& report) {
    std::vector<char> fixed = pinned;
    report.mirrored_parts = 0;
    report.gated_area_percent = 0;
    for (const ReversedPatch& patch : reversed_patches(map)) {
        if (!is_mirrored_part(patch, gate)) continue;
        ++report.mirrored_parts;
        report.gated_area_percent += 100 * patch.area;
        for (const int f : patch.faces)
            for (int k = 0; k < 3; ++k) fixed[std::size_t(map.source().faces(f, k))] = 1;
    }
    return fixed;
}

/// One direction of a map while it is untangled.
class Untangling {
  public:
    Untangling(PointMap& map, const TriangleMesh& source, const TriangleMesh& target,
               const std::vector<char>& pinned, const UntanglingOptions& options)
        : map_(map),
          source_(source),
          target_(target),
          pinned_(pinned),
          options_(options),
          before_(measure_distortion(map, source, target)),
          moving_(map, source, target) {
        report_.flipped_before = report_.flipped_after = before_.flipped_count;
        report_.flipped_area_percent_before = report_.flipped_area_percent_after =
            before_.flipped_area_percent;
        if (options.feature_weight > 0 && options.global_steps > 0)
            features_ = std::make_unique<FeatureAgreement>(moving_, options.feature_weight);
    }

    void unfold() {
        fixed_ = stay(moving_, pinned_, options_.gate, report_);
        run(rounds[0]);
        if (!options_.replace_parts) return;
        replacement_ = std::make_unique<PartReplacement>(moving_, pinned_, options_.parts);
        replacement_->continue_surroundings();
    }

    const PointMap& points() const { return moving_.points(); }
    void reconcile(const PointMap& back, bool whole) {
        if (replacement_) replacement_->adopt_inverse(back, whole && double(pinned_.size()) <= large);
    }

    const UntanglingReport& report() const { return report_; }
    UntanglingReport finish() {
        fixed_ = stay(moving_, pinned_, options_.gate, report_);
        run(rounds[1]);
        if (options_.align_normals) align_normals();
        if (replacement_) {
            report_.parts_tried = replacement_->report().tried;
            report_.parts_replaced = replacement_->report().replaced;
            report_.replaced_area_percent = replacement_->report().area_percent;
        }
        const Distortion after = measure_distortion(moving_.points(), source_, target_);
        if (after.flipped_area_percent > before_.flipped_area_percent) return report_;
        map_ = moving_.points();
        report_.flipped_after = after.flipped_count;
        report_.flipped_area_percent_after = after.flipped_area_percent;
        return report_;
    }

  private:
    void run(const Round& round) {
        report_.global_steps += relax(moving_, fixed_, features_.get(), round, options_);
        report_.sweeps += FoldRemoval{options_.fold_sweeps, round.fold_visits}(moving_, fixed_);
    }
    void align_normals() {
        NormalAgreement agreement(moving_);
        const std::vector<int> disagreeing = agreement.disagreeing_faces();
        report_.disagreeing_before = int(disagreeing.size());
        report_.disagreeing_after = int(agreement.improve(disagreeing, fixed_).size());
    }

    PointMap& map_;
    const TriangleMesh &source_, &target_;
    const std::vector<char>& pinned_;
    const UntanglingOptions& options_;
    Distortion before_;
    MovingMap moving_;
    std::vector<char> fixed_;
    std::unique_ptr<FeatureAgreement> features_;
    std::unique_ptr<PartReplacement> replacement_;
    UntanglingReport report_;
};

}  // namespace

UntanglingReport untangle(PointMap& map, const TriangleMesh& source, const TriangleMesh& target,
                          const std::vector<char>& pinned, const UntanglingOptions& options) {
    Untangling untangling(map, source, target, pinned, options);
    if (!options.enabled) return untangling.report();
    untangling.unfold();
    return untangling.finish();
}

UntanglingReports untangle(MapPair& maps, const TriangleMesh& A, const TriangleMesh& B,
                           const PinnedPair& pinned, const UntanglingOptions& options) {
    Untangling there(maps.A_to_B, A, B, pinned.A, options), back(maps.B_to_A, B, A, pinned.B, options);
    if (!options.enabled) return {there.report(), back.report()};
    tbb::parallel_invoke([&] { there.unfold(); }, [&] { back.unfold(); });
    for (int round = 0; round < reconciliations; ++round) {
        const PointMap A_to_B = there.points(), B_to_A = back.points();
        tbb::parallel_invoke([&] { there.reconcile(B_to_A, round == 0); },
                             [&] { back.reconcile(A_to_B, round == 0); });
    }
    UntanglingReports reports;
    tbb::parallel_invoke([&] { reports.A_to_B = there.finish(); }, [&] { reports.B_to_A = back.finish(); });
    return reports;
}

}  // namespace varimap
