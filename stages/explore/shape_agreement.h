#pragma once

#include <vector>

#include "varimap/multilevel/pair_context.h"
#include "varimap/results/map_pair.h"

namespace varimap {

/// How well maps between two surfaces of unit area bring like places together, by cues that do not go into
/// the maps' energies. Each is a mean over the surfaces, of both directions; the surfaces may be of opposite
/// handedness. Keeps a reference to the context.
class ShapeAgreement {
  public:
    explicit ShapeAgreement(const PairContext& context);

    /// Of relief (relief_agreement.h): a correlation, 1 at best, mean of two scales. 0.75 at a scale at which
    /// either surface has none. Of two sheets agreement_of_bent_sheets at least: less tells nothing.
    double relief(const MapPair& maps) const;
    /// How well patches can be laid onto their images: of all rotations R of a patch, with points x of
    /// normals n and images y of normals m, relative to the patch's and the image's centres and mean square
    /// radii r and s,
    ///     max over R of mean(y . R x / (r s) + m . R n) / 2,
    /// 1 at best, mean of patches of two sizes. Limbs may bend between patches; which side of a limb is
    /// which, and what belongs beside what, shows within them.
    double alignment(const MapPair& maps) const;
    /// How much distances along the surface change: mean of |log| of the ratios
    ///     d_A(p, psi(q)) / d_B(phi(p), q)
    /// over places p of A and q of B, for the maps phi from A to B and psi back; of each, most_stretch at
    /// most. 0 at best.
    double stretch(const MapPair& maps) const;

  private:
    struct Patch {
        std::vector<int> vertices;
        double weight;
    };
    struct Side {
        const TriangleMesh& mesh;
        Eigen::VectorXd mass;
        std::vector<Eigen::VectorXd> relief;  ///< per scale; outward
        Points normals;                       ///< of vertices, outward
        std::vector<int> samples;             ///< vertices, spread over the surface
        Eigen::VectorXd sample_mass;          ///< of their cells
        RowMatrix distance;                   ///< vertices x samples
        std::vector<Patch> patches;           ///< of all sizes

        Side(const SurfaceData& data, const GeodesicGraph& graph);
    };
    double relief(const PointMap& map, const Side& source, const Side& target) const;
    double alignment(const PointMap& map, const Side& source, const Side& target) const;

    Side A_, B_;
    bool opposed_;  ///< of opposite handedness
    bool sheets_;   ///< both surfaces (mesh/boundary.h)
};

/// |log| of the ratio of two distances from which on they do not agree at all.
constexpr double most_stretch = 0.25;

}  // namespace varimap
