#pragma once

#include <vector>

#include "stages/explore/surface_components.h"
#include "varimap/multilevel/pair_context.h"
#include "varimap/quality/patch_alignment.h"
#include "varimap/results/map_pair.h"
#include "varimap/spectral/local_shape.h"

namespace varimap {

/// How well maps between two surfaces of unit area bring like places together, by cues that do not go into
/// the maps' energies. Each is a mean over the surfaces, of both directions; the surfaces may be of opposite
/// handedness. Keeps references.
class ShapeAgreement {
  public:
    ShapeAgreement(const PairContext& context, const PairHandedness& handedness,
                   const SurfaceComponents& components_A, const SurfaceComponents& components_B);

    /// Of relief (relief_agreement.h): a correlation, 1 at best, mean of two scales. 0.75 at a scale at which
    /// either surface has none. Of two sheets agreement_of_bent_sheets at least: less tells nothing.
    double relief(const MapPair& maps) const;
    /// How well patches of two sizes can be laid onto their images (patch_alignment.h), 1 at best.
    double alignment(const MapPair& maps) const;
    /// How much distances along the surface change: mean of |log| of the ratios
    ///     d_A(p, psi(q)) / d_B(phi(p), q)
    /// over places p of A and q of B, for the maps phi from A to B and psi back; of each, most_stretch at
    /// most. 0 at best. Where both of a pair lie on different components that a repair joined, on either
    /// surface, distances are straight: ways over its bridges tell where these are.
    double stretch(const MapPair& maps) const;

  private:
    struct Side {
        const TriangleMesh& mesh;
        Eigen::VectorXd mass;
        Points normals;                       ///< of vertices, outward
        std::vector<Eigen::VectorXd> relief;  ///< per scale; outward
        std::vector<int> samples;             ///< vertices, spread over the surface
        Eigen::VectorXd sample_mass;          ///< of their cells
        RowMatrix distance;                   ///< vertices x samples
        const SurfaceComponents& components;
        PatchAlignment patches;

        Side(const SurfaceData& data, const GeodesicGraph& graph, bool inward,
             const SurfaceComponents& components);
        bool are_on_different_components(int vertex, const SurfacePoint& point) const;
        double straight_distance(int vertex, const SurfacePoint& point) const;
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
