#include "varimap/spectral/local_shape.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "varimap/core/parallel.h"
#include "varimap/mesh/mass.h"
#include "varimap/mesh/ray_mesh.h"
#include "varimap/mesh/topology.h"

namespace varimap {

namespace {

constexpr double largest_feature = 2.5;  ///< in standard deviations

/// Closed surfaces enclose a positive volume if their faces look outward; the orientation of others is that
/// of the file.
bool looks_inward(const Surface& surface) {
    if (!is_closed(surface.mesh)) return surface.mirrored;
    return signed_volume(surface.mesh) < 0;
}

Points outward_normals(const Surface& surface) {
    const Points normals = vertex_normals(surface.mesh);
    return looks_inward(surface) ? Points(-normals) : normals;
}

/// Compresses heights of either sign, relative to the typical one. Flat surfaces have none.
Eigen::VectorXd compressed(const Eigen::VectorXd& height) {
    constexpr double flat = 1e-4;  // units of sqrt(area)
    return (height / std::max(median(height.cwiseAbs()), flat)).array().asinh();
}

/// Of mean 0 and variance 1, without outliers; what hardly varies stays small, for it may be noise.
Eigen::VectorXd standardised(const Eigen::VectorXd& feature, const Eigen::VectorXd& mass) {
    constexpr double least_deviation = 0.2;
    const Eigen::ArrayXd centred = feature.array() - mass.dot(feature);
    const double deviation = std::sqrt(mass.dot(centred.square().matrix()));
    return (centred / std::max(deviation, least_deviation)).max(-largest_feature).min(largest_feature);
}

/// The inward normal and three directions around it.
std::array<Vec3, 4> inward_cone(const Vec3& inward) {
    constexpr double spread = 0.5;  // tangent of the cone's half angle
    const Vec3 u = inward.unitOrthogonal(), v = inward.cross(u);
    std::array<Vec3, 4> rays{inward};
    for (int k = 0; k < 3; ++k) {
        const double angle = 2 * M_PI * k / 3;
        rays[k + 1] = (inward + spread * (std::cos(angle) * u + std::sin(angle) * v)).normalized();
    }
    return rays;
}

/// Mean length of the rays of the inward cone at a place, each at most `longest`: so long are all where there
/// is no normal.
double depth(const RayMesh& rays, const TriangleMesh& mesh, const Vec3& origin, const Vec3& inward,
             double longest) {
    if (inward.isZero(0)) return longest;
    double sum = 0;
    for (const Vec3& direction : inward_cone(inward)) {
        const SurfacePoint hit = rays.first_hit(origin, direction);
        const double length = hit.face < 0 ? longest : (position(mesh, hit) - origin).norm();
        sum += std::min(length, longest);
    }
    return sum / 4;
}

}  // namespace

Eigen::VectorXd bending(const SurfaceData& data, double time) {
    const Surface& surface = data.surface;
    const RowMatrix phi = diffusion_embedding(data.basis, time);  // exp(-lambda t / 2) phi
    const RowMatrix smoothed = phi * (phi.transpose() * (surface.mass.asDiagonal() * surface.mesh.vertices));
    return (surface.mesh.vertices - smoothed).cwiseProduct(outward_normals(surface)).rowwise().sum();
}

Eigen::VectorXd thickness(const Surface& surface) {
    constexpr double lift = 1e-4, longest = 0.6;  // units of sqrt(area)
    const RayMesh rays(surface.mesh);
    const Points normals = outward_normals(surface);
    Eigen::VectorXd result(normals.rows());
    parallel_for_each_index(normals.rows(), Eigen::Index(64), [&](Eigen::Index v) {
        const Vec3 inward = -normals.row(v).transpose();
        const Vec3 origin = surface.mesh.vertex(int(v)) + lift * inward;
        result[v] = lift + depth(rays, surface.mesh, origin, inward, longest);
    });
    return result;
}

RowMatrix local_shape(const SurfaceData& data) {
    const double t0 = coarsest_time(data.basis);
    const Eigen::VectorXd& mass = data.surface.mass;
    RowMatrix features(mass.size(), 3);
    features.col(0) = standardised(compressed(bending(data, t0 / 8)), mass);
    features.col(1) = standardised(compressed(bending(data, t0 / 32)), mass);
    features.col(2) = standardised(thickness(data.surface).array().log(), mass);
    return features / std::sqrt(3.0);
}

}  // namespace varimap
