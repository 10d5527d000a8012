#include "varimap/relaxation/relief_agreement.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "varimap/mesh/mass.h"
#include "varimap/spectral/laplacian.h"

namespace varimap {

namespace {

constexpr double bound = 2;  ///< of the relief; swept: 1.5 to 4
/// c^2 of the robust function. Swept: from 0.06; at 1 the mean round trip is 0.00179.
constexpr double c2 = 0.25;
/// Of relief, in units of sqrt(area). Swept: from 0.01; 0.04 distorts more (95 % of the faces below 2.07
/// rather than 1.85).
constexpr double finest_scale = 0.02;

Eigen::VectorXd normalised(Eigen::VectorXd values) {
    values.array() -= median(values);
    const double deviation = 1.5 * median(values.cwiseAbs());
    if (!(deviation > 0)) return Eigen::VectorXd::Zero(values.size());
    return bound * (values / (bound * deviation)).array().tanh();
}

}  // namespace

Eigen::VectorXd relief(const TriangleMesh& mesh, double scale) {
    // Unused vertices have no mass, which would leave the matrix singular.
    const Eigen::VectorXd mass = voronoi_masses(mesh).cwiseMax(1e-15);
    Eigen::SparseMatrix<double> diffusion(mass.size(), mass.size());
    diffusion.setIdentity();
    diffusion = mass.asDiagonal() * diffusion;
    diffusion += scale * scale * cotangent_laplacian(mesh);
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(diffusion);
    const Points smooth = solver.solve(mass.asDiagonal() * mesh.vertices);
    return normalised((mesh.vertices - smooth).cwiseProduct(vertex_normals(mesh)).rowwise().sum());
}

ReliefAgreement::ReliefAgreement(const SlidingMap& map, double weight)
    : map_(map), weight_(weight * voronoi_masses(map.source())) {
    const double scale =
        std::max({finest_scale, equilateral_edge(map.source()), equilateral_edge(map.target())});
    source_ = relief(map.source(), scale);
    target_ = relief(map.target(), scale);
}

double ReliefAgreement::residual(int v) const {
    const SurfacePoint& image = map_.point(v);
    double there = 0;
    for (int k = 0; k < 3; ++k) there += image.barycentric[k] * target_[map_.target().faces(image.face, k)];
    return source_[v] - there;
}

double ReliefAgreement::value(int v) const {
    const double r = residual(v);
    return weight_[v] * c2 / 2 * std::log1p(r * r / c2);
}

ReliefAgreement::Quadratic ReliefAgreement::derivatives(int v, const TangentFrame& frame) const {
    const TriangleMesh& target = map_.target();
    const int face = map_.point(v).face;
    const Vec3 n = face_normal(target, face);
    if (!(n.squaredNorm() > 0)) return {Eigen::Vector2d::Zero(), Eigen::Matrix2d::Zero()};
    Vec3 slope = Vec3::Zero();
    for (int k = 0; k < 3; ++k) {
        const Vec3 opposite =
            target.vertex(target.faces(face, (k + 2) % 3)) - target.vertex(target.faces(face, (k + 1) % 3));
        slope += target_[target.faces(face, k)] * n.cross(opposite);
    }
    const Eigen::Vector2d J = frame.transpose() * slope / n.squaredNorm();
    const double r = residual(v), u = weight_[v] / (1 + r * r / c2);
    return {-u * r * J, u * J * J.transpose()};
}

}  // namespace varimap
