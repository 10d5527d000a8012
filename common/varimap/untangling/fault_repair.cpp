#include "varimap/untangling/fault_repair.h"

#include <algorithm>

#include "varimap/core/index_set.h"
#include "varimap/core/log.h"
#include "varimap/map_repair/chart_repair.h"
#include "varimap/parts/missed_parts.h"
#include "varimap/relaxation/fold_removal.h"
#include "varimap/relaxation/movable_vertices.h"
#include "varimap/untangling/rounds.h"

namespace varimap {

namespace {

constexpr double last_fold_visits = 8;  ///< as in the first round
/// Faces that may be faulty in the end where faults are mapped anew once more: a torn map has hundreds, for
/// which that would take long.
constexpr int few_faults = 100;
/// By the other direction; more, as of a limb that one direction mirrors, where the other has far fewer.
constexpr int few_to_adopt = 300;
constexpr int far_fewer = 4;
/// Of all faces: so many faulty ones more is a limb worth which a direction had lost. Repairs that follow
/// mend most of them.
constexpr double few_more = 0.003;

void log_repair(const ChartRepair::Report& report) {
    const auto count = [&](ChartRepair::Outcome outcome) { return report.outcomes[std::size_t(outcome)]; };
    using enum ChartRepair::Outcome;
    if (std::all_of(report.outcomes.begin(), report.outcomes.end(), [](int n) { return n == 0; })) return;
    log("repair: {} parts taken from the other direction, {} mapped anew in charts; in vain: {} for want "
        "of a disc, {} of a simple rim, {} folded, {} not better",
        count(inverted), count(repaired), count(no_disc), count(no_simple_rim), count(folded),
        count(no_gain));
}

}  // namespace

void FaultRepair::operator()(const PointMap& back) {
    if (options_.align_normals) report_.disagreeing_before = repair_all(back);
    if (!may_be_done_again() && !may_be_recovered()) judges_.reset();
}

FaultJudges& FaultRepair::judges() {
    if (!judges_) judges_ = std::make_unique<FaultJudges>(map_);
    return *judges_;
}

void FaultRepair::recount() {
    if (faults_) count_faults();
    count_what_disagrees();
}

void FaultRepair::count_faults() {
    faults_ = int(judges().along_target.faulty_faces().size());
}

void FaultRepair::count_what_disagrees() {
    report_.disagreeing_after = int(judges().agreement.disagreeing_faces().size());
}

int FaultRepair::repair_all(const PointMap& back) {
    std::vector<int> disagreeing = judges().agreement.disagreeing_faces();
    const int before = int(disagreeing.size());
    repair(back, std::move(disagreeing));
    count_what_disagrees();
    return before;
}

bool FaultRepair::is_done_again() const {
    return may_be_done_again() && faults_ && *faults_ > 0 && *faults_ <= few_faults;
}

void FaultRepair::again(const PointMap& back) {
    if (!is_done_again()) return;
    const PointMap kept = map_.points();
    const int faults = *faults_;
    repair(back, {});
    if (*faults_ > faults) {
        map_.restore(kept);
        faults_ = faults;
    }
    count_what_disagrees();
}

FaultRepair::State FaultRepair::state() const {
    return {map_.points(), report_, faults_};
}

void FaultRepair::restore(const State& state) {
    map_.restore(state.points);
    report_ = state.report;
    faults_ = state.faults;
}

void FaultRepair::recover(const PointMap& back) {
    if (!may_be_recovered()) return;
    const State before = state();
    if (!recover_missed_parts(map_, back, held(), landmarks_, options_.inverse_weight)) return;
    repair_all(back);
    const int more = *faults_ - before.faults.value_or(0);
    if (more <= few_more * map_.source().face_count()) return;
    log("{} faulty faces more come of them: they are left", more);
    restore(before);
}

bool FaultRepair::may_adopt(const FaultRepair& other) const {
    return faults_ && other.faults_ && *other.faults_ < *faults_ &&
           (*faults_ <= few_to_adopt || far_fewer * *other.faults_ <= *faults_);
}

bool FaultRepair::adopt(const PointMap& back) {
    const State before = state();
    take_from_other_direction(map_, back, faulty_vertices(), with_boundary(held(), map_.source()));
    repair_all(back);
    if (*faults_ < *before.faults) return true;
    restore(before);
    return false;
}

VertexData<bool> FaultRepair::faulty_vertices() {
    VertexData<bool> marks(map_.source().vertex_count());
    for (const int f : judges().along_target.faulty_faces()) mark_corners(map_.source(), f, marks);
    return marks;
}

VertexData<bool> FaultRepair::held() const {
    return held_vertices(map_, fixed_, landmarks_);
}

bool FaultRepair::may_be_done_again() const {
    return options_.repair_again && count_used_vertices(map_.source()) <= large_surface;
}

bool FaultRepair::may_be_recovered() const {
    return options_.replace_parts && options_.align_normals;
}

void FaultRepair::repair(const PointMap& back, std::vector<int> disagreeing) {
    auto& [along_target, agreement] = judges();
    const VertexData<bool> stays = held();
    ChartRepair charts(map_, along_target, agreement, back, relief_);
    const std::vector<int> touched = charts(stays);
    disagreeing.insert(disagreeing.end(), touched.begin(), touched.end());
    make_set(disagreeing);
    agreement.improve(agreement.disagreeing_among(disagreeing), stays);
    // What is upright along the target may still be reversed by the normals at its corners.
    report_.sweeps +=
        FoldRemoval{options_.fold_sweeps, std::min(last_fold_visits, options_.most_fold_visits)}(map_, stays);
    // What was no disc, or had no simple rim, may be one now.
    charts(stays);
    if (options_.centre_stars) charts.centre_stars(stays);
    log_repair(charts.report());
    if (may_be_done_again() || may_be_recovered()) count_faults();
}

}  // namespace varimap
