#include "varimap/untangling/untangled_direction.h"

#include <algorithm>

#include "varimap/core/index_set.h"
#include "varimap/core/timing.h"
#include "varimap/map_repair/bound_repair.h"
#include "varimap/map_repair/fault_guard.h"
#include "varimap/map_repair/normal_agreement.h"
#include "varimap/mesh/boundary.h"
#include "varimap/relaxation/fold_removal.h"
#include "varimap/relaxation/movable_vertices.h"
#include "varimap/sliding/along_target.h"
#include "varimap/sliding/face_energy.h"
#include "varimap/untangling/rounds.h"

namespace varimap {

namespace {

constexpr int steps_after_repairs = 4;  ///< chosen by hand
constexpr int settling_sweeps = 3;      ///< local ones in each of its steps where there are no global ones
/// Energy of a direction, times the other's, from which on all of it may be taken from the other.
constexpr double much_worse = 1.2;
/// Times the steps for sheets, which boundaries make slide as a whole: slowly, since each direction holds the
/// other. Of five sheets errors fall by 40 %; cut bodies stay as they are.
constexpr int more_steps = 3;

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

int disagreeing_faces(SlidingMap map) {
    AlongTarget along_target(map);
    return int(NormalAgreement(map, along_target).disagreeing_faces().size());
}

std::size_t count_reversed_along_target(const SlidingMap& map) {
    AlongTarget along_target(map);
    return faces_where(all_indices(map.source().face_count()),
                       [&](int f) { return along_target.is_reversed(f); })
        .size();
}

}  // namespace

UntanglingReport untouched(const Distortion& before) {
    UntanglingReport report;
    report.flipped_before = report.flipped_after = before.flipped_count;
    report.flipped_area_percent_before = report.flipped_area_percent_after = before.flipped_area_percent;
    return report;
}

UntangledDirection::UntangledDirection(PointMap& map, const TriangleMesh& source, const TriangleMesh& target,
                                       const VertexData<bool>& pinned, const PointPairs& points,
                                       const UntanglingOptions& options, std::vector<ReliefPair> reliefs)
    : map_(map),
      source_(source),
      target_(target),
      pinned_(pinned),
      options_(options),
      before_(measure_distortion(map, source, target)),
      sliding_(map, source, target),
      landmarks_(landmark_constraints(sliding_, points)),
      are_sheets_(options.global_steps > 0 && is_sheet(source) && is_sheet(target)),
      report_(untouched(before_)) {
    if (!reliefs.empty())
        relief_ = std::make_unique<ReliefAgreement>(sliding_, options.relief_weight, std::move(reliefs));
}

void UntangledDirection::trust_relief(double share) {
    relief_->scale_weight(share);
    if (share == 0) relief_.reset();
}

void UntangledDirection::start_relaxation(const Round& round) {
    fixed_ = stay(sliding_, pinned_, options_.gate, report_);
    sweep(round);
    relaxation_ = relaxation(round, (are_sheets_ ? more_steps : 1) * options_.global_steps);
    if (options_.area_bound > 0 && AreaBound::is_tight(options_.area_bound)) keep_bound();
}

void UntangledDirection::relax(const PointMap& back) {
    if (is_relaxed()) return;
    if (bound_) bound_->press();
    relaxation_->step(back);
}

void UntangledDirection::end_relaxation(const Round& round) {
    if (relaxation_) report_.global_steps += relaxation_->steps();
    relaxation_.reset();
    // Folds of a map that was carried over are left to the repair in charts, which makes fewer branch
    // points of them.
    if (options_.local_sweeps > 0 && options_.align_normals) return;
    const double visits = std::min(round.fold_visits, options_.most_fold_visits);
    report_.sweeps +=
        FoldRemoval{options_.fold_sweeps, visits}(sliding_, held_vertices(sliding_, fixed_, landmarks_));
}

void UntangledDirection::start_settling() {
    if (options_.area_bound > 0 && !bound_) keep_bound();
    relaxation_ = relaxation(settling_round, most_settling_steps());
}

bool UntangledDirection::is_settled() const {
    return settling_steps_ >= most_settling_steps() || (relaxation_ ? relaxation_->done() : !bound_);
}

void UntangledDirection::settle(const PointMap& back) {
    if (is_settled()) return;
    ++settling_steps_;
    if (relaxation_) {
        if (bound_) bound_->press();
        relaxation_->step(back);
        return;
    }
    pressed_ = settling_steps_ == 1 ? bound_->press() : bound_->press_again(pressed_);
    sweep(free_among(pressed_), settling_round, settling_sweeps);
}

void UntangledDirection::end_settling() {
    bound_.reset();
    end_relaxation(settling_round);
}

void UntangledDirection::replace_parts(const PointMap& back) {
    bound_.reset();
    if (!options_.replace_parts) return;
    replacement_ = std::make_unique<PartReplacement>(sliding_, pinned_, options_.parts, landmarks_);
    replacement_->continue_surroundings(back);
}

double UntangledDirection::energy() const {
    return mean_energy(sliding_, RobustEnergy(judged_energy, options_.parts.rules.robustness));
}

bool UntangledDirection::is_much_worse_than(const UntangledDirection& other) const {
    return options_.replace_parts && energy() > much_worse * other.energy();
}

void UntangledDirection::reconcile(const PointMap& back, bool whole) {
    if (replacement_)
        replacement_->adopt_inverse(back, whole && count_used_vertices(source_) <= large_surface);
}

void UntangledDirection::repair(const PointMap& back) {
    repair_.emplace(sliding_, fixed_, landmarks_, relief_.get(), options_, report_);
    (*repair_)(back);
}

void UntangledDirection::start_settling_again() {
    const int vertices = std::max(count_used_vertices(source_), count_used_vertices(target_));
    if (options_.settling_steps > 0 && options_.align_normals && vertices <= large_surface)
        relaxation_ = relaxation(settling_round, steps_after_repairs);
}

void UntangledDirection::end_settling_again() {
    relaxation_.reset();
    repair_->recount();
}

void UntangledDirection::guard(const std::function<void()>& move) {
    std::vector<int> free;
    for (int v = 0; v < source_.vertex_count(); ++v)
        if (!fixed_[v]) free.push_back(v);
    FaultGuard{sliding_, repair_->judges()}(free, move);
}

void UntangledDirection::adopt(const PointMap& back, bool upright) {
    const VertexData<bool> stayed = fixed_;
    if (upright) fixed_ = pinned_;
    if (!repair_->adopt(back))
        fixed_ = stayed;
    else if (upright)
        fixed_ = stay(sliding_, pinned_, options_.gate, report_);
}

void UntangledDirection::restore_bound() {
    if (!options_.restore_bound || !options_.align_normals || options_.settling_steps == 0 ||
        !(options_.area_bound > 0))
        return;
    // As repairs do: nothing else holds a rim to the target's.
    BoundRepair repair(sliding_, options_.area_bound, exempt(),
                       with_boundary(with_landmarks(fixed_), source_));
    repair({options_.area_weight, settling_round.regularisation});
}

bool UntangledDirection::is_worse(const Distortion& after) const {
    // A large triangle that is reversed instead of many small ones is no reason to give up the rest. Nor are
    // triangles that are reversed by the normals at their corners, where fewer are as they lie along the
    // target: three of 36 pairs lost repairs of 30 to 70 triangles so.
    return after.flipped_area_percent > before_.flipped_area_percent &&
           after.flipped_count >= before_.flipped_count &&
           count_reversed_along_target(sliding_) >= count_reversed_along_target({map_, source_, target_});
}

UntanglingReport UntangledDirection::finish() {
    if (replacement_) {
        report_.parts_tried = replacement_->report().tried;
        report_.parts_replaced = replacement_->report().replaced;
        report_.replaced_area_percent = replacement_->report().area_percent;
    }
    const Distortion after = measure_distortion(sliding_.points(), source_, target_);
    if (is_worse(after)) return left_as_it_was();
    map_ = sliding_.points();
    report_.flipped_after = after.flipped_count;
    report_.flipped_area_percent_after = after.flipped_area_percent;
    return report_;
}

UntanglingReport UntangledDirection::left_as_it_was() const {
    UntanglingReport report = untouched(before_);
    if (options_.align_normals)
        report.disagreeing_before = report.disagreeing_after = disagreeing_faces({map_, source_, target_});
    report.mirrored_parts = report_.mirrored_parts;
    report.gated_area_percent = report_.gated_area_percent;
    return report;
}

std::unique_ptr<RoundRelaxation> UntangledDirection::relaxation(const Round& round, int steps) {
    if (options_.global_steps == 0 || steps == 0) return nullptr;
    if (!boundaries_) boundaries_.emplace(sliding_);
    boundaries_->match();
    return std::make_unique<RoundRelaxation>(sliding_, fixed_, relief_.get(), landmarks_, *boundaries_,
                                             are_sheets_, round, steps, options_);
}

void UntangledDirection::keep_bound() {
    bound_ = std::make_unique<AreaBound>(sliding_, options_.area_bound, exempt());
}

int UntangledDirection::most_settling_steps() const {
    return (bound_ && AreaBound::is_tight(options_.area_bound) ? 2 : 1) * options_.settling_steps;
}

void UntangledDirection::sweep(const Round& round) {
    if (options_.local_sweeps > 0)
        sweep(free_vertices(sliding_, fixed_, landmarks_), round, options_.local_sweeps);
}

void UntangledDirection::sweep(std::vector<int> vertices, const Round& round, int sweeps) {
    const Timer timer("sweeps");
    LocalRelaxation local(sliding_, 99);
    for (int i = 0; i < sweeps; ++i) local.sweep(vertices, {options_.area_weight, round.regularisation});
}

std::vector<int> UntangledDirection::free_among(std::vector<int> vertices) const {
    const std::vector<int> free = free_vertices(sliding_, fixed_, landmarks_);
    std::erase_if(vertices, [&](int v) { return !std::binary_search(free.begin(), free.end(), v); });
    return vertices;
}

VertexData<bool> UntangledDirection::exempt() const {
    return with_landmarks(pinned_);
}

VertexData<bool> UntangledDirection::with_landmarks(VertexData<bool> marks) const {
    for (const SoftConstraint& landmark : landmarks_) mark_corners(source_, landmark.from.face, marks);
    return marks;
}

}  // namespace varimap
