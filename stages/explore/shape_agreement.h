#pragma once

#include <vector>

#include "varimap/mesh/domain.h"
#include "varimap/relaxation/untangling.h"

namespace varimap {

/// How well maps between two surfaces of unit area bring like places together, by cues that do not go into
/// the maps' energies. Each is a correlation over the source, 1 at best, mean of both directions; the
/// surfaces may be of opposite handedness. Keeps references to the meshes.
class ShapeAgreement {
  public:
    ShapeAgreement(const Domain& A, const Domain& B);

    /// Of relief (relief_agreement.h), mean of two scales.
    double relief(const MapPair& maps) const;
    /// Of normal curvatures along the source's edges and along their images, of both surfaces smoothed at
    /// bending_scale: how they bend, and in which direction, where relief knows their mean curvature alone.
    /// A limb turned about its axis keeps most of the latter and little of the former.
    double bending(const MapPair& maps) const;

  private:
    struct Side {
        const TriangleMesh& mesh;
        Eigen::VectorXd mass;
        std::vector<Eigen::VectorXd> relief;  ///< per scale; outward
        TriangleMesh smooth;
        Points normals;  ///< of `smooth`, outward

        explicit Side(const Domain& surface);
    };
    static double relief(const PointMap& map, const Side& source, const Side& target);
    static double bending(const PointMap& map, const Side& source, const Side& target);

    Side A_, B_;
};

/// Units of sqrt(area). Of .02, .03, .05 and .1, all of which divide right maps from wrong ones of generated
/// pairs about as well, .1 a little less.
constexpr double bending_scale = 0.05;

}  // namespace varimap
