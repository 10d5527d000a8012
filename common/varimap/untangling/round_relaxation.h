#pragma once

#include <vector>

#include "varimap/relaxation/boundary_agreement.h"
#include "varimap/relaxation/global_relaxation.h"
#include "varimap/relaxation/local_relaxation.h"
#include "varimap/untangling/rounds.h"
#include "varimap/untangling/untangling_options.h"

namespace varimap {

/// Global steps of a round over the whole map, each followed by a local sweep that lets single vertices out
/// of corners. Keeps references.
class RoundRelaxation {
  public:
    /// `sheets`: both surfaces are.
    RoundRelaxation(SlidingMap& map, const VertexData<bool>& fixed, const ReliefAgreement* relief,
                    const std::vector<SoftConstraint>& landmarks, const BoundaryAgreement& boundaries,
                    bool sheets, const Round& round, int steps, const UntanglingOptions& options);

    /// `back`: the other direction, whose inverse the map is drawn to.
    void step(const PointMap& back);
    bool done() const { return converged_ || steps_ >= most_; }
    int steps() const { return steps_; }

  private:
    /// Where few steps are taken the directions cannot follow each other as far.
    double inverse_share() const;

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

}  // namespace varimap
