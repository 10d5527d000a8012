#pragma once

#include "varimap/multilevel/pair_context.h"

namespace varimap {

/// Adds the Wasserstein-2 cost between positions in space to a level's costs (Sec. 2.3), in units in which
/// the surfaces' variances in space and in the level's embedding agree. For aligned surfaces.
void add_wasserstein_term(LevelPair& pair, const PairContext& context, double weight);

/// Features of both surfaces, vertices x F each, whose squared distances are added to the costs of a level: a
/// term of data beside Eq. (3). The energy feels whether neighbours stay together; where shapes differ in
/// proportions it would rather slide along a body than stretch it, and only the look of places can tell.
class FeatureTerm {
  public:
    FeatureTerm(const PairContext& context, double weight);
    /// Samples have the mean features of their cells. At weight 1 a difference of 1 costs as much as the
    /// neighbourhoods' own mean variance, both sides together, at any level.
    void add_to(LevelPair& pair) const;

  private:
    double weight_;
    RowMatrix features_A_, features_B_;  ///< of local_shape(); empty where the weight is 0
};

}  // namespace varimap
