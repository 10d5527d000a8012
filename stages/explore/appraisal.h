#pragma once

#include <vector>

#include "stages/explore/shape_agreement.h"
#include "varimap/results/candidate.h"
#include "varimap/results/map_pair.h"

namespace varimap {

/// A map solved for on all levels and relaxed on the meshes, which are meant to be coarse.
struct FinishedMap {
    int start = 0;      ///< which of the starts it was; of several that became the same, the first
    MapPair maps;       ///< per vertex of either mesh, on faces of the other
    double energy = 0;  ///< Eq. (3) on the last level, of every vertex
    /// On its way there: on the first level, and on each Euclidean one.
    std::vector<double> rough_scores{};
};

/// What tells the right map from wrong ones, whether they are relaxed or not (shape_agreement.h).
struct Cues {
    double relief = 0, alignment = 0, stretch = 0;
};

/// Fills in the cues, and the score: by these, and by the strain and the missed landmarks that are there
/// already.
void set_cues(Candidate& candidate, const Cues& cues);
/// The score of an isometry with these cues: of a map that is not finished, strain tells nothing.
double rough_score(const Cues& cues);

/// Measures maps of a pair, and keeps what of its surfaces that needs.
class Appraisal {
  public:
    /// Keeps a reference to the context.
    explicit Appraisal(const PairContext& context);
    Appraisal(const Appraisal&) = delete;
    Appraisal& operator=(const Appraisal&) = delete;

    /// Fills in what is known of the map by itself, and its score. `landmarks`: those that it is to meet,
    /// which need not be the context's.
    void measure(const FinishedMap& map, const VertexPairs<MeshVertex>& landmarks,
                 Candidate& candidate) const;
    /// What can be measured of a map that is not finished, too: energy, strain and what it reverses tell
    /// nothing as long as it has folds.
    Cues cues(const MapPair& maps) const;

    const PairHandedness& handedness() const { return handedness_; }
    const SurfaceComponents& components_A() const { return components_A_; }
    const SurfaceComponents& components_B() const { return components_B_; }

  private:
    const PairContext& context_;
    const PairHandedness handedness_;
    const SurfaceComponents components_A_, components_B_;
    const ShapeAgreement agreement_;  ///< refers to these
};

/// Fills in what a map is to the best one.
void compare(const MapPair& best, const MapPair& other, const PairContext& context, Candidate& candidate);

}  // namespace varimap
