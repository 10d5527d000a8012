#include "varimap/parts/part_trial.h"

#include <algorithm>

#include "varimap/core/timing.h"
#include "varimap/relaxation/fold_removal.h"
#include "varimap/sliding/face_energy.h"

namespace varimap {

namespace {

constexpr int relaxation_steps = 4;
/// Share of the energy that a step must win to be followed by another.
constexpr double least_relaxation_gain = 0.01;
const RobustEnergy relaxed_energy{judged_energy, 0.3};
/// Of an alternative, so of what it is compared with: or it wins by being relaxed.
constexpr int relaxations = 2;
constexpr int fold_sweeps = 40;
constexpr double fold_visits = 60;  ///< of a part's vertices, in the mean
constexpr int fold_strikes = 2;
constexpr double promising = 1.3;  ///< times the energy to beat, after folds were removed once
constexpr double hopeless = 2.5;   ///< times the energy to beat, before folds are removed
/// Area of the target that an alternative may leave: the most of so many mean vertices' areas, and the least
/// of a share of the part's area and a share of the surface's.
constexpr double lost_vertices = 12, lost_share = 0.5, lost_most = 0.035;

/// Strain / that of the part as it is, before and after an alternative that may be an untwisted one is
/// relaxed further, so often. Chosen by hand on a hammer and a spoon, whose handles were turned by 180
/// degrees: .63 and 1.2 before, .58 and .61 after.
constexpr double maybe_untwisted = 1.5, untwisted = 0.7;
constexpr int untwisting = 3;

}  // namespace

OpenPart::OpenPart(const SlidingMap& map, const FaceData<bool>& inside, const VertexData<bool>& fixed)
    : open(fixed.size(), false), held(fixed.size(), true), area(area_of(map, inside)) {
    const TriangleMesh& source = map.source();
    for (int f = 0; f < source.face_count(); ++f) mark_corners(source, f, open);
    for (int f = 0; f < source.face_count(); ++f)
        for (int k = 0; k < 3; ++k)
            if (!inside[f]) open[source.faces(f, k)] = false;
    for (int f = 0; f < source.face_count(); ++f)
        for (int k = 0; k < 3; ++k)
            if (marked_corners(source, f, open) > 0) held[source.faces(f, k)] = fixed[source.faces(f, k)];
    for (int f = 0; f < source.face_count(); ++f)
        if (marked_corners(source, f, held) < 3) faces.push_back(f);
}

void PartTrial::set_standard() {
    before_ = context_.map.points();
    for (const SoftConstraint& constraint : context_.constraints)
        if (marked_corners(context_.map.source(), constraint.from.face, part_.held) < 3)
            constraints_.push_back(constraint);
    global_ = std::make_unique<GlobalRelaxation>(context_.map, part_.held);
    global_->set_constraints(context_.landmarks);
    for (int i = 0; i < relaxations; ++i) relax();
    strain_before_ = strain();
    energy_to_beat_ = (1 - context_.rules.gain) * energy();
    occupied_before_ = context_.cells.occupied(context_.map.points());
}

bool PartTrial::run(const Proposal& propose) {
    propose(part_.open);
    for (int v = 0; v < part_.open.size(); ++v)
        if (part_.open[v] && context_.fixed[v]) context_.map.place(v, before_[v]);
    relax();
    if (energy() < hopeless * energy_to_beat_) {
        remove_folds();
        relax();
    }
    if (energy() < promising * energy_to_beat_) remove_folds();
    const double reached = energy();
    if (reached < energy_to_beat_ && covers_as_much()) return true;
    if (context_.rules.untwist && untwists()) return true;
    nearest_ = std::min(nearest_, reached / energy_to_beat_);
    restore();
    return false;
}

void PartTrial::restore() {
    for (int v = 0; v < part_.open.size(); ++v)
        if ((part_.open[v] || !part_.held[v]) && before_[v].face >= 0) context_.map.place(v, before_[v]);
}

void PartTrial::relax() {
    const Timer timer("parts, global steps");
    for (int step = 0; step < relaxation_steps; ++step)
        if (global_->step(relaxed_energy) < least_relaxation_gain) return;
}

void PartTrial::remove_folds() {
    const Timer timer("parts, removal of folds");
    const double share = double(std::count(part_.held.begin(), part_.held.end(), 0)) / context_.vertices;
    FoldRemoval{fold_sweeps, fold_visits * share, fold_strikes}(context_.map, part_.held);
}

bool PartTrial::untwists() {
    if (strain() > maybe_untwisted * strain_before_ || !enters_the_same()) return false;
    remove_folds();
    for (int i = 0; i < untwisting; ++i) relax();
    return strain() < untwisted * strain_before_ && enters_the_same();
}

bool PartTrial::enters_the_same() const {
    const double few = lost_vertices / context_.vertices;
    const std::vector<char> now = context_.cells.occupied(context_.map.points());
    return context_.cells.lost_area(occupied_before_, now) <= few &&
           context_.cells.lost_area(now, occupied_before_) <= few;
}

double PartTrial::tolerated_loss() const {
    return std::max(lost_vertices / context_.vertices, std::min(lost_share * part_.area, lost_most));
}

bool PartTrial::covers_as_much() const {
    return context_.cells.lost_area(occupied_before_, context_.cells.occupied(context_.map.points())) <=
           tolerated_loss();
}

double PartTrial::strain() const {
    return total_energy(context_.map, part_.faces, RobustEnergy(judged_energy, context_.rules.robustness));
}

double PartTrial::energy() const {
    double sum = strain();
    for (const SoftConstraint& constraint : constraints_) sum += value(constraint, context_.map);
    return sum;
}

}  // namespace varimap
