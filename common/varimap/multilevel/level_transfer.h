#pragma once

#include <vector>

#include "varimap/mesh/vertex_index.h"
#include "varimap/spectral/level.h"
#include "varimap/transport/alternating_minimization.h"

namespace varimap {

/// One surface at one level: its samples, the transport problem's side, and the level's embedding of all
/// vertices.
struct LevelSide {
    Level level;
    RowMatrix vertex_points;      ///< mesh vertices x D
    Eigen::VectorXd vertex_mass;  ///< per mesh vertex
    double truncation = 0;        ///< epsilon, below which the level's weights are dropped
    Side side;
};

/// Two surfaces at one level.
struct LevelPair {
    LevelSide A, B;
    Partners partners;  ///< landmarks
};

/// The samples and cells of two surfaces at one level, without an embedding.
struct Levels {
    Level A, B;
};

/// Builds a side from a level, the embedding of all vertices, their masses, and epsilon.
LevelSide make_level_side(Level level, RowMatrix vertex_points, const Eigen::VectorXd& vertex_mass,
                          double truncation);

/// Landmarks that are samples of both levels, with their weight (cost.h).
Partners partners_at(const LevelPair& pair, const VertexPairs<MeshVertex>& landmarks, double weight);

/// Where a level starts: centres, before landmarks pull them, and the kept entries of the plan before it.
struct Start {
    Centres centres;
    KeptEntries kept;
};

/// The full plan, from centres at the origin of the embeddings.
Start zero_start(const LevelPair& pair);

/// Level switch: a new sample takes its parent's mean image, recomputed with the new embedding's mean over
/// the cells of the parent's partners, then smoothed by W; children inherit the parent's kept entries. What
/// does not depend on the plan is computed once, so that many plans can be handed down.
class LevelSwitch {
  public:
    /// Refers to `fine`, which must outlive it.
    LevelSwitch(const Level& coarse_A, const Level& coarse_B, const LevelPair& fine);
    Start hand_down(const Coupling& coarse_plan, double support_threshold) const;

  private:
    const LevelPair& fine_;
    Eigen::VectorXd coarse_mass_A_, coarse_mass_B_;
    std::vector<int> parent_A_, parent_B_;
    RowMatrix means_A_, means_B_;  ///< per coarse sample: mean over its cell in the fine level's embedding
};

}  // namespace varimap
