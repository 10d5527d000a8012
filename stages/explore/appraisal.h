#pragma once

#include <vector>

#include "stages/explore/shape_agreement.h"
#include "varimap/relaxation/untangling.h"
#include "varimap/results/candidate.h"

namespace varimap {

/// A map solved for on all levels and relaxed on the meshes, which are meant to be coarse.
struct FinishedMap {
    int start = 0;      ///< which of the starts it was; of several that became the same, the first
    MapPair maps;       ///< per vertex of either mesh, on faces of the other
    double energy = 0;  ///< Eq. (3) on the last level, of every vertex
    std::vector<double> rough_scores{};  ///< on its way there, level by level
};

/// Measures maps of a pair.
class Appraisal {
  public:
    /// Keeps a reference to the context.
    explicit Appraisal(const PairContext& context);

    /// Fills in what is known of the map by itself, and its score.
    void measure(const FinishedMap& map, Candidate& candidate) const;
    /// Of a map that is not finished: all but energy, strain and what it reverses, which tell nothing as long
    /// as a map has folds. The score goes by the strain that is there already.
    void measure_roughly(const MapPair& maps, Candidate& candidate) const;
    /// What the score of such a map will be, but for strain.
    double rough_score(const MapPair& maps) const;

  private:
    const PairContext& context_;
    ShapeAgreement agreement_;
};

/// Fills in what a map is to the best one.
void compare(const FinishedMap& best, const FinishedMap& other, const PairContext& context,
             Candidate& candidate);

}  // namespace varimap
