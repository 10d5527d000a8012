#include "varimap/untangling/round_relaxation.h"

#include <algorithm>

#include "varimap/relaxation/movable_vertices.h"
#include "varimap/relaxation/soft_constraints.h"

namespace varimap {

namespace {

constexpr int least_steps = 2;
/// Share of the energy that a step must win to be followed by another. Swept, same bytes: 1e-6 to 1e-4.
constexpr double least_round_gain = 1e-5;

}  // namespace

RoundRelaxation::RoundRelaxation(SlidingMap& map, const VertexData<bool>& fixed,
                                 const ReliefAgreement* relief, const std::vector<SoftConstraint>& landmarks,
                                 const BoundaryAgreement& boundaries, bool sheets, const Round& round,
                                 int steps, const UntanglingOptions& options)
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
    const double affordable = steps * large_surface / double(vertices_.size() + 1);
    most_ = std::min(steps, std::max(least_steps, int(affordable)));
}

void RoundRelaxation::step(const PointMap& back) {
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
    converged_ = gain < least_round_gain && steps_ > 3;
}

double RoundRelaxation::inverse_share() const {
    const double progress = (steps_ + 1.0) / asked_;
    return round_.first_inverse + (round_.last_inverse - round_.first_inverse) * progress * progress;
}

}  // namespace varimap
