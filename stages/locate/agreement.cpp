#include "stages/locate/agreement.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "varimap/mesh/interpolation.h"

namespace varimap {

namespace {

// The patches of exploration (shape_agreement.h), of which the smaller ones are enough here. In units of
// sqrt(area) of the whole.
constexpr double patch_radius = 0.25;
constexpr std::size_t patch_count = 60;

}  // namespace

PlacementAgreement::PlacementAgreement(const Sketches& sketches, const Sides& sides, double share)
    : whole_(sides.whole.mesh),
      whole_normals_(outward_normals(whole_, sides.handedness.B_inward)),
      opposed_(sides.handedness.are_opposite()),
      patches_(sides.part.mesh.vertices, outward_normals(sides.part.mesh, sides.handedness.A_inward),
               sides.part.mass) {
    const std::vector<int> centres = spread_vertices(sketches.part.data.hierarchy, patch_count);
    patches_.add_patches(distances_from_each(sketches.part.graph, centres), patch_radius / std::sqrt(share),
                         Eigen::VectorXd::Ones(Eigen::Index(centres.size())));
}

double PlacementAgreement::operator()(const Placement& placement) const {
    if (!std::isfinite(placement.strain)) return -std::numeric_limits<double>::infinity();
    const Points images = positions(whole_, placement.images),
                 normals = pulled_back(whole_normals_, whole_, placement.images);
    return 0.5 * placement.relief + 2 * patches_(images, normals, opposed_) -
           0.3 * std::min(placement.strain, 1.0);
}

}  // namespace varimap
