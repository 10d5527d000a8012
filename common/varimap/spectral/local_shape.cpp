#include "varimap/spectral/local_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "varimap/core/parallel.h"
#include "varimap/core/statistics.h"
#include "varimap/mesh/boundary.h"
#include "varimap/mesh/ray_mesh.h"

namespace varimap {

namespace {

/// Compresses heights of either sign, relative to the typical one. Flat surfaces have none.
Eigen::VectorXd compressed(const Eigen::VectorXd& height) {
    constexpr double flat = 1e-4;  // units of sqrt(area): what files and rounding leave of a plane
    return (height / std::max(upper_median(height.cwiseAbs()), flat)).array().asinh();
}

/// Of mean 0 and variance 1, without outliers; what hardly varies stays small, for it may be noise.
Eigen::VectorXd standardised(const Eigen::VectorXd& values, const Eigen::VectorXd& mass) {
    constexpr double least_deviation = 0.2;  // of what is compressed; chosen by hand, not swept
    const Eigen::ArrayXd centred = values.array() - mass.dot(values);
    const double deviation = std::sqrt(mass.dot(centred.square().matrix()));
    return (centred / std::max(deviation, least_deviation)).max(-largest_descriptor).min(largest_descriptor);
}

/// The inward normal and three directions around it.
std::array<Vec3, 4> inward_cone(const Vec3& inward) {
    constexpr double spread = 0.5;  // tangent of the cone's half angle; chosen by hand, not swept
    const Vec3 u = inward.unitOrthogonal(), v = inward.cross(u);
    std::array<Vec3, 4> rays{inward};
    for (int k = 0; k < 3; ++k) {
        const double angle = 2 * std::numbers::pi * k / 3;
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

bool is_inward(int sign, const Domain& surface) {
    return sign == 0 ? surface.mirrored : sign < 0;
}

}  // namespace

PairHandedness::PairHandedness(const Domain& A, const Domain& B) {
    int sign_A = orientation_sign(A.mesh), sign_B = orientation_sign(B.mesh);
    if (A.mirrored == B.mirrored) {
        if (sign_A == 0) sign_A = sign_B;
        if (sign_B == 0) sign_B = sign_A;
    }
    A_inward = is_inward(sign_A, A);
    B_inward = is_inward(sign_B, B);
}

bool is_inward(const Domain& surface) {
    return is_inward(orientation_sign(surface.mesh), surface);
}

Points outward_normals(const TriangleMesh& mesh, bool inward) {
    const Points normals = vertex_normals(mesh);
    return inward ? Points(-normals) : normals;
}

Eigen::VectorXd bending(const Domain& surface, const Points& normals, const Basis& basis, double time) {
    const RowMatrix phi = diffusion_embedding(basis, time);  // exp(-lambda t / 2) phi
    const RowMatrix smoothed = phi * (phi.transpose() * (surface.mass.asDiagonal() * surface.mesh.vertices));
    return (surface.mesh.vertices - smoothed).cwiseProduct(normals).rowwise().sum();
}

Eigen::VectorXd shape_diameter(const TriangleMesh& mesh, const Points& normals) {
    constexpr double lift = 1e-4;    // units of sqrt(area): past the faces around the vertex itself
    constexpr double longest = 0.6;  // units of sqrt(area): a little more than through a sphere, .564
    const RayMesh rays(mesh);
    Eigen::VectorXd result(normals.rows());
    parallel_for_each_index(normals.rows(), Eigen::Index(64), [&](Eigen::Index v) {
        const Vec3 inward = -normals.row(v).transpose();
        const Vec3 origin = mesh.vertex(int(v)) + lift * inward;
        result[v] = lift + depth(rays, mesh, origin, inward, longest);
    });
    return result;
}

LocalShape local_shape(const Domain& surface, const Basis& basis) {
    // Times chosen by hand on the known pairs, not swept.
    constexpr double tenth = 4e-3;  // units of area: smooths over about a tenth of sqrt(area)
    if (!surface.is_surface())
        return {RowMatrix::Zero(surface.mass.size(), 3), Eigen::VectorXd::Zero(surface.mass.size())};
    const double t0 = coarsest_time(basis);
    const Eigen::VectorXd& mass = surface.mass;
    const Points normals = outward_normals(surface.mesh, is_inward(surface));
    LocalShape shape{RowMatrix(mass.size(), 3), bending(surface, normals, basis, tenth)};
    shape.descriptors.col(0) = standardised(compressed(bending(surface, normals, basis, t0 / 8)), mass);
    shape.descriptors.col(1) = standardised(compressed(bending(surface, normals, basis, t0 / 32)), mass);
    shape.descriptors.col(2) = standardised(shape_diameter(surface.mesh, normals).array().log(), mass);
    shape.descriptors /= std::sqrt(3.0);
    return shape;
}

}  // namespace varimap
