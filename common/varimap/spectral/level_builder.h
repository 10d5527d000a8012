#pragma once

#include <optional>
#include <vector>

#include "varimap/geodesics/geodesic_graph.h"
#include "varimap/spectral/eigenbasis.h"
#include "varimap/spectral/level.h"
#include "varimap/spectral/neighbourhoods.h"
#include "varimap/surface/domain.h"

namespace varimap {

/// epsilon and tau are the paper's; the others were chosen by hand on the known pairs, not swept, but for
/// sampled_share: .22, .35 and .5 were compared on every other known pair.
struct HierarchyOptions {
    double truncation = 0.5;  ///< epsilon: weights below it are dropped (Sec. 3.2)
    double density =
        0.9;  ///< tau: a level is dense enough when every vertex has W > tau to a sample (Sec. 4.2)
    double growth = 1.05;  ///< diffusion levels end when the next one has fewer than this times the samples
    int minimum_neighbours = 10;  ///< lower bound on Euclidean neighbourhoods (Sec. 4.5)
    double sampled_share = 0.35;  ///< of the vertices, on the last level but one, at least
    int last_neighbours = 12;     ///< neighbours on the last level, which has every vertex
};

/// Makes levels of one domain. Refers to what it is given.
class LevelBuilder {
  public:
    LevelBuilder(const Domain& domain, const Basis& basis, const GeodesicGraph& graph,
                 const HierarchyOptions& options)
        : domain_(domain), basis_(basis), graph_(graph), options_(options) {}

    /// Seeds, then farthest vertices in diffusion distance until the level is dense or has `limit` samples;
    /// with no seeds from the most extreme vertex. Without its weights.
    Level diffusion_cells(double time, const std::vector<int>& seeds, int limit) const;
    /// Gives a diffusion level its weights.
    void weigh(Level& level) const;
    /// Seeds, then farthest vertices in geodesic distance.
    struct Euclidean {
        std::optional<Level>
            dense;  ///< until the level is dense; none if that takes more than `most` samples
        std::optional<Level> least;  ///< instead of this, with `least` samples, where that is asked for
    };
    Euclidean euclidean(double sigma, const std::vector<int>& seeds, std::optional<int> least,
                        int most) const;
    /// Every vertex a sample, with a sigma of its own: the distance to its `neighbours`-th neighbour has W =
    /// epsilon.
    Level full(int neighbours) const;
    /// The level with further vertices as samples (landmarks must be samples at every level); cells, masses
    /// and weights are those of the enlarged set. Returns the level unchanged if all are samples already.
    Level euclidean_with(const Level& level, const std::vector<int>& vertices) const;
    /// The same of a diffusion level. `embedding`: of all vertices at the level's time.
    Level diffusion_with(const Level& level, const std::vector<int>& vertices,
                         const RowMatrix& embedding) const;
    /// The same without weights.
    Level diffusion_cells_with(const Level& level, const std::vector<int>& vertices,
                               const RowMatrix& embedding) const;

  private:
    BallRule ball_rule(double sigma) const;
    template <class Sampling>
    Level euclidean_level(const Sampling& sampling, double sigma) const;

    const Domain& domain_;
    const Basis& basis_;
    const GeodesicGraph& graph_;
    const HierarchyOptions& options_;
};

}  // namespace varimap
