#include "stages/locate/agreement.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace varimap {

namespace {

// The patches of exploration (shape_agreement.h), of which the smaller ones are enough here. In units of
// sqrt(area) of the whole.
constexpr double patch_radius = 0.25;
constexpr std::size_t patch_count = 60;

}  // namespace

PlacementAgreement::PlacementAgreement(const Sketches& sketches, const Sides& sides, double share)
    : whole_(sides.whole.mesh),
      whole_normals_(outward_normals(sides.whole)),
      opposed_(sides.are_opposed()),
      patches_(sides.part.mesh.vertices, outward_normals(sides.part), sides.part.mass) {
    const std::vector<int> centres = spread_vertices(sketches.part.data.hierarchy, patch_count);
    patches_.add_patches(distances_from_each(sketches.part.graph, centres), patch_radius / std::sqrt(share),
                         Eigen::VectorXd::Ones(Eigen::Index(centres.size())));
}

double PlacementAgreement::operator()(const Placement& placement) const {
    if (!std::isfinite(placement.strain)) return -std::numeric_limits<double>::infinity();
    Points images(Eigen::Index(placement.images.size()), 3), normals(images);
    for (Eigen::Index v = 0; v < images.rows(); ++v) {
        const SurfacePoint& image = placement.images[std::size_t(v)];
        images.row(v) = position(whole_, image).transpose();
        normals.row(v).setZero();
        for (int k = 0; k < 3; ++k)
            normals.row(v) += image.barycentric[k] * whole_normals_.row(whole_.faces(image.face, k));
    }
    return 0.5 * placement.relief + 2 * patches_(images, normals, opposed_) -
           0.3 * std::min(placement.strain, 1.0);
}

}  // namespace varimap
