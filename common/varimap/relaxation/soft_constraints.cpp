#include "varimap/relaxation/soft_constraints.h"

#include <cmath>

#include "varimap/mesh/interpolation.h"
#include "varimap/mesh/mass.h"

namespace varimap {

namespace {

Vec3 offset(const SoftConstraint& constraint, const SlidingMap& map) {
    Vec3 image = Vec3::Zero();
    for (const auto [vertex, weight] : WeightedCorners(map.source(), constraint.from))
        image += weight * map.image(vertex);
    return image - constraint.to;
}

}  // namespace

double value(const SoftConstraint& constraint, const SlidingMap& map) {
    const double c2 = constraint.radius * constraint.radius;
    return constraint.weight * c2 / 2 * std::log1p(offset(constraint, map).squaredNorm() / c2);
}

FaceDerivatives derivatives(const SoftConstraint& constraint, const SlidingMap& map,
                            const VertexData<TangentFrame>& frames) {
    const auto corners = map.source().faces.row(constraint.from.face);
    const Vec3 d = offset(constraint, map);
    Eigen::Matrix<double, 3, 6> J;
    for (int k = 0; k < 3; ++k) J.middleCols<2>(2 * k) = constraint.from.barycentric[k] * frames[corners[k]];
    const double u = constraint.weight / (1 + d.squaredNorm() / (constraint.radius * constraint.radius));
    return {u * J.transpose() * d, u * J.transpose() * J};
}

std::vector<SoftConstraint> landmark_constraints(const SlidingMap& map, const PointPairs& landmarks) {
    constexpr double weight = 1e4, radius = 1;
    std::vector<SoftConstraint> constraints;
    for (const auto& [from, to] : landmarks)
        if (map.is_mapped(from.face))
            constraints.push_back({from, position(map.target(), to), weight, radius});
    return constraints;
}

std::vector<SoftConstraint> inverse_constraints(const SlidingMap& map, const PointMap& back, double weight) {
    const Eigen::VectorXd areas = voronoi_masses(map.target());
    std::vector<SoftConstraint> constraints;
    constraints.reserve(back.size());
    for (int b = 0; b < int(back.size()); ++b) {
        const SurfacePoint& point = back[b];
        if (point.face >= 0 && map.is_mapped(point.face))
            constraints.push_back({point, map.target().vertex(b), weight * areas[b], inverse_radius});
    }
    return constraints;
}

}  // namespace varimap
