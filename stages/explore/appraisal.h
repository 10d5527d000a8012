#pragma once

#include "stages/explore/finishing.h"
#include "stages/explore/shape_agreement.h"
#include "varimap/results/candidate.h"

namespace varimap {

/// Measures finished maps of a pair.
class Appraisal {
  public:
    /// Keeps a reference to the context.
    explicit Appraisal(const PairContext& context);

    /// Fills in what is known of the map by itself, and its score.
    void measure(const FinishedMap& map, Candidate& candidate) const;

  private:
    const PairContext& context_;
    ShapeAgreement agreement_;
};

/// Fills in what a map is to the best one.
void compare(const FinishedMap& best, const FinishedMap& other, const PairContext& context,
             Candidate& candidate);

}  // namespace varimap
