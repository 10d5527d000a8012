#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "varimap/mesh/vertex_index.h"
#include "varimap/multilevel/level_transfer.h"
#include "varimap/spectral/level_builder.h"
#include "varimap/spectral/surface_data.h"

namespace varimap {

/// samples x 3: where a level's samples lie in space.
RowMatrix sample_positions(const Domain& domain, const Level& level);

/// Two surfaces with their landmarks and these' weight (cost.h): builds the level pairs that the solving
/// stages work on.
class PairContext {
  public:
    /// `landmarks_left_out`: how many others were given, which these surfaces are too coarse to hold.
    PairContext(SurfaceData A, SurfaceData B, VertexPairs<MeshVertex> landmarks, double landmark_weight = 1,
                int landmarks_left_out = 0);

    const SurfaceData& A() const { return A_.data; }
    const SurfaceData& B() const { return B_.data; }
    const GeodesicGraph& graph_A() const { return A_.graph; }
    const GeodesicGraph& graph_B() const { return B_.graph; }
    const VertexPairs<MeshVertex>& landmarks() const { return landmarks_; }
    /// The landmarks of one surface, as vertices of its mesh.
    const std::vector<int>& landmarks_A() const { return A_.landmarks; }
    const std::vector<int>& landmarks_B() const { return B_.landmarks; }
    double landmark_weight() const { return landmark_weight_; }
    /// Where it is not 0, landmarks have other rows here than they were given with.
    int landmarks_left_out() const { return landmarks_left_out_; }
    int landmarks_given() const { return int(landmarks_.size()) + landmarks_left_out_; }

    /// Number of diffusion levels of the pair; the surface with fewer stays at its last one meanwhile.
    int diffusion_levels() const;
    /// Levels in the surfaces' own diffusion embeddings (Eq. 4), landmarks inserted and joined.
    LevelPair diffusion_level(int index) const;
    /// The same without embeddings.
    Levels diffusion_samples(int index) const;
    /// Nor with weights where landmarks are inserted.
    Levels diffusion_cells(int index) const;
    /// Their number, on the side that has fewer. Builds no level.
    int diffusion_sample_count(int index) const;
    /// The last diffusion level that has these samples, in this order; -1 if there is none. Builds no level.
    int find_diffusion_level(const std::vector<int>& samples_A, const std::vector<int>& samples_B) const;

    /// Number of Euclidean levels of the pair: sampled ones, then that with every vertex.
    int euclidean_levels() const;
    /// Levels in the mixed metric (x, mu c psi): positions in R^3 beside normalised diffusion coordinates
    /// psi = Phi / sqrt(1 + K) at the last diffusion level's time, scaled by c so that short edges measure
    /// alike in both, reduced to its principal directions. The second part keeps apart limbs that are close
    /// in space. mu = 0: R^3 alone. Of a domain with intrinsic coordinates: these, whatever mu is.
    LevelPair euclidean_level(int index, double mu) const;

  private:
    struct Side {
        SurfaceData data;
        GeodesicGraph graph;
        std::vector<int> landmarks;  ///< vertices of the mesh

        Side(SurfaceData own, std::vector<int> vertices)
            : data(std::move(own)), graph(data.surface), landmarks(std::move(vertices)) {}
        const Level& diffusion_source(int index) const;
        LevelBuilder builder() const { return {data.surface, data.basis, graph, data.hierarchy.options}; }
        LevelSide joined(Level level, RowMatrix vertex_points) const;
        /// psi in its principal directions, and c; made when it is first asked for.
        struct Psi {
            std::once_flag once;
            RowMatrix points;
            double scale = 0;
        };
        const Psi& psi() const;
        RowMatrix mixed_points(double mu) const;

      private:
        std::shared_ptr<Psi> psi_ = std::make_shared<Psi>();
    };
    const Level& euclidean_source(const Side& side, int index) const;
    LevelPair joined(LevelSide A, LevelSide B) const;

    Side A_, B_;
    VertexPairs<MeshVertex> landmarks_;
    double landmark_weight_;
    int landmarks_left_out_;
};

}  // namespace varimap
