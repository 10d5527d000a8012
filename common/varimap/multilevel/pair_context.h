#pragma once

#include <vector>

#include "varimap/multilevel/level_transfer.h"
#include "varimap/spectral/surface_data.h"

namespace varimap {

/// samples x 3: where a level's samples lie in space.
RowMatrix sample_positions(const Surface& surface, const Level& level);

/// Two surfaces with their landmarks and these' weight (cost.h): builds the level pairs that the solving
/// stages work on.
class PairContext {
  public:
    PairContext(SurfaceData A, SurfaceData B, VertexPairs<MeshVertex> landmarks, double landmark_weight = 1);

    const SurfaceData& A() const { return A_; }
    const SurfaceData& B() const { return B_; }
    const GeodesicGraph& graph_A() const { return graph_A_; }
    const GeodesicGraph& graph_B() const { return graph_B_; }
    /// The same for long distances between samples of diffusion levels (sample_graph.h).
    const GeodesicGraph& sample_graph_A() const { return sample_graph_A_; }
    const GeodesicGraph& sample_graph_B() const { return sample_graph_B_; }
    const VertexPairs<MeshVertex>& landmarks() const { return landmarks_; }
    double landmark_weight() const { return landmark_weight_; }

    /// Number of diffusion levels of the pair; the surface with fewer stays at its last one meanwhile.
    int diffusion_levels() const;
    /// Levels in the surfaces' own diffusion embeddings (Eq. 4), landmarks inserted and joined.
    LevelPair diffusion_level(int index) const;

    /// Number of Euclidean levels of the pair: sampled ones, then the two with every vertex.
    int euclidean_levels() const;
    /// Levels in the mixed metric (x, mu c psi): positions in R^3 beside normalised diffusion coordinates
    /// psi = Phi / sqrt(1 + K) at the last diffusion level's time, scaled by c so that short edges measure
    /// alike in both, reduced to its principal directions. The second part keeps apart limbs that are close
    /// in space. mu = 0: R^3 alone.
    LevelPair euclidean_level(int index, double mu) const;

  private:
    LevelSide euclidean_side(const SurfaceData& data, const GeodesicGraph& graph, int index, double mu,
                             const std::vector<int>& landmarks) const;
    const Level& euclidean_source(const SurfaceData& data, int index) const;

    SurfaceData A_, B_;
    GeodesicGraph graph_A_, graph_B_, sample_graph_A_, sample_graph_B_;
    VertexPairs<MeshVertex> landmarks_;
    double landmark_weight_;
    std::vector<int> landmarks_A_, landmarks_B_;
};

}  // namespace varimap
