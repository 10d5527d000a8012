#include "varimap/relaxation/untangling.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>

#include "varimap/core/index_set.h"
#include "varimap/core/log.h"
#include "varimap/core/timing.h"
#include "varimap/quality/quality.h"
#include "varimap/relaxation/area_bound.h"
#include "varimap/relaxation/boundary_agreement.h"
#include "varimap/relaxation/chart_repair.h"
#include "varimap/relaxation/face_energy.h"
#include "varimap/relaxation/fold_removal.h"
#include "varimap/relaxation/global_relaxation.h"
#include "varimap/relaxation/local_relaxation.h"
#include "varimap/relaxation/missed_parts.h"
#include "varimap/relaxation/normal_agreement.h"
#include "varimap/relaxation/relief_agreement.h"

namespace varimap {

namespace {

/// A round of relaxation and removal of folds.
struct Round {
    double regularisation;     ///< e; where it is large, folds pass through each other
    double robustness_factor;  ///< on the option
    /// Bounds the removal of folds (fold_removal.h). With four times as many 36 pairs take 8 % longer, and no
    /// fewer faces end reversed: what these do not remove is left to the repair in charts.
    double fold_visits;
    double first_inverse;  ///< share of the option's inverse_weight in the first step
    double last_inverse;   ///< the same in the last
};
/// More in the first steps would slow both directions down. Swept: 0.01 to 0.1.
constexpr double first_inverse = 0.03;
/// The first leaves crumpled parts to their replacement; its e swept: 0.15 to 0.6.
constexpr std::array<Round, 2> rounds{
    {{0.3, 3, 8, first_inverse, first_inverse}, {0.1, 1, 20, first_inverse, 1}}};
/// The last, of an unfolded map, which settles into the other's inverse and the area bound.
constexpr Round settling{0.1, 1, 8, 2, 2};
constexpr int settling_sweeps = 3;      ///< local ones in each of its steps where there are no global ones
constexpr double last_fold_visits = 8;  ///< as in the first round
/// Faces that may be faulty in the end where faults are mapped anew once more: a torn map has hundreds, for
/// which that would take long.
constexpr int few_faults = 100;
/// Energy of a direction, times the other's, from which on all of it may be taken from the other.
constexpr double much_worse = 1.2;
/// Times the steps for sheets, which boundaries make slide as a whole: slowly, since each direction holds the
/// other. Of five sheets errors fall by 40 %; cut bodies stay as they are.
constexpr int more_steps = 3;
constexpr double large = 20'000;  ///< vertices from which on fewer global steps are taken
constexpr int least_steps = 2;
/// Share of the energy that a step must win to be followed by another. Swept, same bytes: 1e-6 to 1e-4.
constexpr double least_gain = 1e-5;

/// Vertices that local sweeps may move: those of a face that holds a landmark would leave it.
std::vector<int> free_vertices(const SlidingMap& map, VertexData<bool> fixed,
                               const std::vector<SoftConstraint>& landmarks) {
    for (const SoftConstraint& landmark : landmarks) mark_corners(map.source(), landmark.from.face, fixed);
    std::vector<int> free;
    for (int v = 0; v < fixed.size(); ++v)
        if (!fixed[v] && map.has_image(v)) free.push_back(v);
    return free;
}

/// Global steps over the whole map, each followed by a local sweep that lets single vertices out of corners.
class Relaxation {
  public:
    Relaxation(SlidingMap& map, const VertexData<bool>& fixed, const ReliefAgreement* relief,
               const std::vector<SoftConstraint>& landmarks, const BoundaryAgreement& boundaries, bool sheets,
               const Round& round, int steps, const UntanglingOptions& options)
        : map_(map),
          options_(options),
          landmarks_(landmarks),
          energy_({options.area_weight, round.regularisation}, round.robustness_factor * options.robustness),
          round_(round),
          asked_(steps),
          vertices_(free_vertices(map, fixed, landmarks)),
          global_(map, fixed, relief),
          local_(map, 99),
          are_sheets_(sheets),
          boundaries_(boundaries) {
        // A factorisation takes more than linear time; the first steps are those that matter.
        const double affordable = steps * large / double(vertices_.size() + 1);
        most_ = std::min(steps, std::max(least_steps, int(affordable)));
    }

    /// `back`: the other direction, whose inverse the map is drawn to.
    void step(const PointMap& back) {
        constraints_ = landmarks_;
        if (options_.inverse_weight > 0) {
            const auto inverse = inverse_constraints(map_, back, options_.inverse_weight * inverse_share());
            constraints_.insert(constraints_.end(), inverse.begin(), inverse.end());
        }
        if (options_.boundary_weight > 0) {
            // Rims of bodies' holes find each other late, once the map around them is about right.
            const double share = are_sheets_ ? 1 : inverse_share();
            const auto boundaries = boundaries_.constraints(options_.boundary_weight * share);
            constraints_.insert(constraints_.end(), boundaries.begin(), boundaries.end());
        }
        global_.set_constraints(constraints_);
        const double gain = global_.step(energy_);
        local_.sweep(vertices_, energy_.energy);
        ++steps_;
        converged_ = gain < least_gain && steps_ > 3;
    }
    bool done() const { return converged_ || steps_ >= most_; }
    int steps() const { return steps_; }

  private:
    /// Where few steps are taken the directions cannot follow each other as far.
    double inverse_share() const {
        const double progress = (steps_ + 1.0) / asked_;
        return round_.first_inverse + (round_.last_inverse - round_.first_inverse) * progress * progress;
    }

    SlidingMap& map_;
    const UntanglingOptions& options_;
    const std::vector<SoftConstraint>& landmarks_;
    RobustEnergy energy_;
    Round round_;
    int asked_;  ///< steps
    std::vector<int> vertices_;
    GlobalRelaxation global_;
    LocalRelaxation local_;
    const bool are_sheets_;  ///< both surfaces
    const BoundaryAgreement& boundaries_;
    std::vector<SoftConstraint> constraints_;
    int most_ = 0, steps_ = 0;
    bool converged_ = false;
};

/// Vertices that stay: the pinned ones and those of mirrored parts.
VertexData<bool> stay(const SlidingMap& map, const VertexData<bool>& pinned, const MirrorGate& gate,
                      UntanglingReport& report) {
    VertexData<bool> fixed = pinned;
    report.mirrored_parts = 0;
    report.gated_area_percent = 0;
    for (const ReversedPatch& patch : reversed_patches(map)) {
        if (!is_mirrored_part(patch, gate)) continue;
        ++report.mirrored_parts;
        report.gated_area_percent += 100 * patch.area;
        for (const int f : patch.faces) mark_corners(map.source(), f, fixed);
    }
    return fixed;
}

void log_repair(const ChartRepair::Report& report) {
    const auto count = [&](ChartRepair::Outcome outcome) { return report.outcomes[std::size_t(outcome)]; };
    using enum ChartRepair::Outcome;
    if (std::all_of(report.outcomes.begin(), report.outcomes.end(), [](int n) { return n == 0; })) return;
    log("repair: {} parts taken from the other direction, {} mapped anew in charts; in vain: {} for want "
        "of a disc, {} of a simple rim, {} folded, {} not better",
        count(inverted), count(repaired), count(no_disc), count(no_simple_rim), count(folded),
        count(no_gain));
}

/// One direction of a map while it is untangled.
class Untangling {
  public:
    Untangling(PointMap& map, const TriangleMesh& source, const TriangleMesh& target,
               const VertexData<bool>& pinned, const PointPairs& points, const UntanglingOptions& options)
        : map_(map),
          source_(source),
          target_(target),
          pinned_(pinned),
          options_(options),
          before_(measure_distortion(map, source, target)),
          sliding_(map, source, target),
          landmarks_(landmark_constraints(sliding_, points)),
          are_sheets_(options.global_steps > 0 && is_sheet(source) && is_sheet(target)) {
        report_.flipped_before = report_.flipped_after = before_.flipped_count;
        report_.flipped_area_percent_before = report_.flipped_area_percent_after =
            before_.flipped_area_percent;
        if (options.relief_weight > 0 && options.global_steps > 0)
            relief_ = std::make_unique<ReliefAgreement>(sliding_, options.relief_weight, options.opposed);
    }

    bool are_sheets() const { return are_sheets_; }
    bool has_relief() const { return relief_ != nullptr; }
    double relief_correlation() const { return relief_->correlation(); }
    void trust_relief(double share) {
        relief_->scale_weight(share);
        if (share == 0) relief_.reset();
    }

    /// A round begins with `start_relaxation`, takes relaxation steps, and ends with `end_relaxation`.
    void start_relaxation(const Round& round) {
        fixed_ = stay(sliding_, pinned_, options_.gate, report_);
        sweep(round);
        relaxation_ = relaxation(round, (are_sheets_ ? more_steps : 1) * options_.global_steps);
        if (options_.area_bound > 0 && AreaBound::is_tight(options_.area_bound)) keep_bound();
    }
    bool is_relaxed() const { return !relaxation_ || relaxation_->done(); }
    void relax(const PointMap& back) {
        if (is_relaxed()) return;
        if (bound_) bound_->press();
        relaxation_->step(back);
    }
    /// The last round begins with `start_settling` instead, and takes steps of `settle`.
    void start_settling() {
        relaxation_ = relaxation(settling, options_.settling_steps);
        if (options_.area_bound > 0 && !bound_) keep_bound();
    }
    bool is_settled() const {
        return settling_steps_ >= most_settling_steps() || (relaxation_ ? relaxation_->done() : !bound_);
    }
    void settle(const PointMap& back) {
        if (is_settled()) return;
        ++settling_steps_;
        if (relaxation_) {
            if (bound_) bound_->press();
            relaxation_->step(back);
            return;
        }
        pressed_ = settling_steps_ == 1 ? bound_->press() : bound_->press_again(pressed_);
        sweep(free_among(pressed_), settling, settling_sweeps);
    }
    void end_settling() {
        bound_.reset();
        end_relaxation(settling);
    }
    void end_relaxation(const Round& round) {
        if (relaxation_) report_.global_steps += relaxation_->steps();
        relaxation_.reset();
        // Folds of a map that was carried over are left to the repair in charts, which makes fewer branch
        // points of them.
        if (options_.local_sweeps > 0 && options_.align_normals) return;
        report_.sweeps += FoldRemoval{options_.fold_sweeps, fold_visits(round.fold_visits)}(sliding_, held());
    }

    void replace_parts(const PointMap& back) {
        bound_.reset();
        if (!options_.replace_parts) return;
        replacement_ = std::make_unique<PartReplacement>(sliding_, pinned_, options_.parts, landmarks_);
        replacement_->continue_surroundings(back);
    }

    const PointMap& points() const { return sliding_.points(); }
    /// Of the mapped faces, per area.
    double energy() const {
        return mean_energy(sliding_, RobustEnergy(judged_energy, options_.parts.rules.robustness));
    }
    bool is_much_worse_than(const Untangling& other) const {
        return options_.replace_parts && energy() > much_worse * other.energy();
    }
    void reconcile(const PointMap& back, bool whole) {
        if (replacement_) replacement_->adopt_inverse(back, whole && double(pinned_.size()) <= large);
    }

    const UntanglingReport& report() const { return report_; }
    /// What cannot be slid away (chart_repair.h), and faces that cut through features.
    void repair(const PointMap& back) {
        if (!options_.align_normals) return;
        AlongTarget along_target(sliding_);
        NormalAgreement agreement(sliding_, along_target);
        std::vector<int> left = agreement.disagreeing_faces();
        report_.disagreeing_before = int(left.size());
        left = repair(back, along_target, agreement, std::move(left));
        report_.disagreeing_after = int(agreement.disagreeing_among(left).size());
    }
    bool is_repaired_again() const { return faults_ > 0 && faults_ <= few_faults; }
    /// Once more around the faults that are left; as it was where more come of it.
    void repair_again(const PointMap& back) {
        if (!is_repaired_again()) return;
        const PointMap kept = sliding_.points();
        const int faults = faults_;
        AlongTarget along_target(sliding_);
        NormalAgreement agreement(sliding_, along_target);
        repair(back, along_target, agreement, {});
        if (faults_ > faults) {
            place(kept);
            faults_ = faults;
        }
        report_.disagreeing_after = int(agreement.disagreeing_faces().size());
    }
    /// By the other direction (missed_parts.h), and repairs what comes of it; as it was where more faults
    /// come of it.
    void recover(const PointMap& back) {
        if (!options_.replace_parts || !options_.align_normals) return;
        const PointMap kept = sliding_.points();
        const int faults = faults_;
        if (!recover_missed_parts(sliding_, back, held(), landmarks_, options_.inverse_weight)) return;
        repair(back);
        if (faults_ <= faults) return;
        log("{} faulty faces more come of them: they are left", faults_ - faults);
        place(kept);
        faults_ = faults;
    }
    UntanglingReport finish() {
        if (replacement_) {
            report_.parts_tried = replacement_->report().tried;
            report_.parts_replaced = replacement_->report().replaced;
            report_.replaced_area_percent = replacement_->report().area_percent;
        }
        const Distortion after = measure_distortion(sliding_.points(), source_, target_);
        // A large triangle that is reversed instead of many small ones is no reason to give up the rest.
        if (after.flipped_area_percent > before_.flipped_area_percent &&
            after.flipped_count >= before_.flipped_count)
            return report_;
        map_ = sliding_.points();
        report_.flipped_after = after.flipped_count;
        report_.flipped_area_percent_after = after.flipped_area_percent;
        return report_;
    }

  private:
    std::unique_ptr<Relaxation> relaxation(const Round& round, int steps) {
        if (options_.global_steps == 0 || steps == 0) return nullptr;
        if (!boundaries_) boundaries_.emplace(sliding_);
        boundaries_->match();
        return std::make_unique<Relaxation>(sliding_, fixed_, relief_.get(), landmarks_, *boundaries_,
                                            are_sheets_, round, steps, options_);
    }
    void keep_bound() { bound_ = std::make_unique<AreaBound>(sliding_, options_.area_bound, exempt()); }
    int most_settling_steps() const {
        return (bound_ && AreaBound::is_tight(options_.area_bound) ? 2 : 1) * options_.settling_steps;
    }
    double fold_visits(double of_round) const { return std::min(of_round, options_.most_fold_visits); }
    void sweep(const Round& round) {
        if (options_.local_sweeps > 0)
            sweep(free_vertices(sliding_, fixed_, landmarks_), round, options_.local_sweeps);
    }
    void sweep(std::vector<int> vertices, const Round& round, int sweeps) {
        const Timer timer("sweeps");
        LocalRelaxation local(sliding_, 99);
        for (int i = 0; i < sweeps; ++i) local.sweep(vertices, {options_.area_weight, round.regularisation});
    }
    std::vector<int> free_among(std::vector<int> vertices) const {
        const std::vector<int> free = free_vertices(sliding_, fixed_, landmarks_);
        std::erase_if(vertices, [&](int v) { return !std::binary_search(free.begin(), free.end(), v); });
        return vertices;
    }
    /// Vertices whose surroundings cannot keep the area bound: those of landmarks.
    VertexData<bool> exempt() const {
        VertexData<bool> exempt = pinned_;
        for (const SoftConstraint& landmark : landmarks_) mark_corners(source_, landmark.from.face, exempt);
        return exempt;
    }
    /// The fixed vertices, and those that hold a landmark in place, unless their triangle is reversed.
    VertexData<bool> held() const {
        VertexData<bool> held = fixed_;
        for (const SoftConstraint& landmark : landmarks_)
            if (sliding_.image_triangle(landmark.from.face).D > 0)
                mark_corners(source_, landmark.from.face, held);
        return held;
    }
    /// On a large surface to look at all of it again takes longer than what is won.
    bool may_repair_again() const { return options_.repair_again && double(pinned_.size()) <= large; }
    void place(const PointMap& points) {
        for (int v = 0; v < int(points.size()); ++v)
            if (sliding_.has_image(v)) sliding_.place(v, points[std::size_t(v)]);
    }
    /// `left`: the faces that disagree with the target's normals, ascending. Returns those that may in the
    /// end.
    std::vector<int> repair(const PointMap& back, AlongTarget& along_target, NormalAgreement& agreement,
                            std::vector<int> left) {
        const VertexData<bool> stays = held();
        ChartRepair charts(sliding_, along_target, agreement, back, relief_.get());
        const auto leave = [&](const std::vector<int>& touched) {
            left.insert(left.end(), touched.begin(), touched.end());
        };
        leave(charts(stays));
        make_set(left);
        left = agreement.improve(agreement.disagreeing_among(left), stays);
        // What is upright along the target may still be reversed by the normals at its corners.
        report_.sweeps += FoldRemoval{options_.fold_sweeps, fold_visits(last_fold_visits)}(sliding_, stays);
        // What was no disc, or had no simple rim, may be one now.
        leave(charts(stays));
        if (options_.centre_stars) leave(charts.centre_stars(stays));
        make_set(left);
        log_repair(charts.report());
        if (may_repair_again()) faults_ = charts.faulty_faces();
        return left;
    }

    PointMap& map_;
    const TriangleMesh &source_, &target_;
    const VertexData<bool>& pinned_;
    const UntanglingOptions& options_;
    Distortion before_;
    SlidingMap sliding_;
    const std::vector<SoftConstraint> landmarks_;  ///< that are points
    const bool are_sheets_;                        ///< both surfaces; asked for global steps alone
    VertexData<bool> fixed_;
    std::optional<BoundaryAgreement> boundaries_;  ///< once there are global steps
    std::unique_ptr<ReliefAgreement> relief_;
    std::unique_ptr<Relaxation> relaxation_;
    std::unique_ptr<AreaBound> bound_;
    std::vector<int> pressed_;  ///< where the bound was not kept at the last step
    int settling_steps_ = 0;
    int faults_ = 0;  ///< faulty faces after repair; not counted where none follows
    std::unique_ptr<PartReplacement> replacement_;
    UntanglingReport report_;
};

/// Calls body for both, side by side, with what the other's images are before.
template <class Body>
void with_each_other(Untangling& there, Untangling& back, const Body& body) {
    const PointMap A_to_B = there.points(), B_to_A = back.points();
    tbb::parallel_invoke([&] { body(there, B_to_A); }, [&] { body(back, A_to_B); });
}

/// A round of both directions, which draw each other towards their inverses.
void run(Untangling& there, Untangling& back, const Round& round) {
    tbb::parallel_invoke([&] { there.start_relaxation(round); }, [&] { back.start_relaxation(round); });
    while (!there.is_relaxed() || !back.is_relaxed())
        with_each_other(there, back, [](Untangling& map, const PointMap& inverse) { map.relax(inverse); });
    tbb::parallel_invoke([&] { there.end_relaxation(round); }, [&] { back.end_relaxation(round); });
}

void weigh_relief(Untangling& there, Untangling& back) {
    const double agreement = (there.relief_correlation() + back.relief_correlation()) / 2;
    const double trust = trust_in_relief(agreement, there.are_sheets());
    there.trust_relief(trust);
    back.trust_relief(trust);
    if (trust < 1)
        log("reliefs agree by {:.2f} before the map is relaxed: they count by {:.2f}", agreement, trust);
}

/// The last round.
void settle(Untangling& there, Untangling& back) {
    tbb::parallel_invoke([&] { there.start_settling(); }, [&] { back.start_settling(); });
    while (!there.is_settled() || !back.is_settled())
        with_each_other(there, back, [](Untangling& map, const PointMap& inverse) { map.settle(inverse); });
    tbb::parallel_invoke([&] { there.end_settling(); }, [&] { back.end_settling(); });
}

}  // namespace

UntanglingReports untangle(MapPair& maps, const TriangleMesh& A, const TriangleMesh& B,
                           const PinnedPair& pinned, const UntanglingOptions& options) {
    Untangling there(maps.A_to_B, A, B, pinned.A, pinned.points, options),
        back(maps.B_to_A, B, A, pinned.B, swapped(pinned.points), options);
    if (!options.enabled) return {there.report(), back.report()};
    if (options.weigh_relief && there.has_relief()) weigh_relief(there, back);
    if (options.local_sweeps == 0) run(there, back, rounds[0]);
    with_each_other(there, back,
                    [](Untangling& map, const PointMap& inverse) { map.replace_parts(inverse); });
    const bool whole_there = there.is_much_worse_than(back), whole_back = back.is_much_worse_than(there);
    with_each_other(there, back, [&](Untangling& map, const PointMap& inverse) {
        map.reconcile(inverse, &map == &there ? whole_there : whole_back);
    });
    run(there, back, rounds[1]);
    if (options.settling_steps > 0) settle(there, back);
    with_each_other(there, back, [](Untangling& map, const PointMap& inverse) { map.repair(inverse); });
    // By the other direction as it has come out: often only one of them was tangled.
    if (there.is_repaired_again() || back.is_repaired_again())
        with_each_other(there, back,
                        [](Untangling& map, const PointMap& inverse) { map.repair_again(inverse); });
    with_each_other(there, back, [](Untangling& map, const PointMap& inverse) { map.recover(inverse); });
    UntanglingReports reports;
    tbb::parallel_invoke([&] { reports.A_to_B = there.finish(); }, [&] { reports.B_to_A = back.finish(); });
    return reports;
}

}  // namespace varimap
