#include "varimap/relaxation/local_relaxation.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

#include "varimap/relaxation/face_energy.h"

namespace varimap {

namespace {

constexpr int backtracks = 7;
constexpr double longest_step = 2;  ///< of a Newton step, in lengths of the vertex's longest source edge

/// Gradient, Hessian and value of the energy of the faces around one vertex, in its tangent plane.
struct Quadratic {
    double value = 0, squared_longest_edge = 0;  ///< of the source
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
    Eigen::Matrix2d hessian = Eigen::Matrix2d::Zero();
};

void add_face(Quadratic& sum, const SlidingMap& map, const TangentFrame& frame, int f, int v,
              const FoldEnergy& energy) {
    const int i = map.corner_of(f, v), j = (i + 1) % 3, k = (i + 2) % 3;
    const RestTriangle& rest = map.rest(f);
    const ImageTriangle image = map.image_triangle(f);
    const auto d = energy.derivatives(image.q, image.D);
    const CornerGradient gradient = corner_gradient(map, f, i, image);
    const Eigen::Vector2d q = frame.transpose() * gradient.q / rest.area;
    const Eigen::Vector2d D = frame.transpose() * gradient.D / (2 * rest.area);
    sum.value += rest.area * d.f;
    sum.gradient += rest.area * (d.f_q * q + d.f_D * D);
    sum.hessian += rest.area * gradient_products(q, D, d.f_qD, d.f_DD);
    sum.hessian.diagonal().array() += d.f_q * (rest.cotangent[j] + rest.cotangent[k]);
    const TriangleMesh& source = map.source();
    for (const int corner : {j, k})
        sum.squared_longest_edge =
            std::max(sum.squared_longest_edge,
                     (source.vertex(source.faces(f, corner)) - source.vertex(v)).squaredNorm());
}

/// Newton's direction with the Hessian's eigenvalues made positive.
Eigen::Vector2d descent(const Quadratic& quadratic) {
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen;
    eigen.computeDirect(quadratic.hessian);
    const Eigen::Vector2d size = eigen.eigenvalues().cwiseAbs();
    const double least = 1e-6 * size.maxCoeff();
    if (!(least > 0)) return Eigen::Vector2d::Zero();
    const Eigen::Vector2d along = eigen.eigenvectors().transpose() * quadratic.gradient;
    return -(eigen.eigenvectors() * along.cwiseQuotient(size.cwiseMax(least)));
}

}  // namespace

void LocalRelaxation::sweep(std::vector<int>& vertices, const FoldEnergy& energy, bool leap) {
    shuffle(vertices);
    for (const int v : vertices) {
        newton_step(v, energy);
        if (leap && has_reversed_face(v)) leap_to_mean(v, energy);
    }
}

/// Fisher-Yates with xorshift numbers, the same everywhere.
void LocalRelaxation::shuffle(std::vector<int>& vertices) {
    for (std::size_t i = vertices.size(); i > 1; --i) {
        state_ ^= state_ << 13;
        state_ ^= state_ >> 17;
        state_ ^= state_ << 5;
        std::swap(vertices[i - 1], vertices[state_ % i]);
    }
}

bool LocalRelaxation::has_reversed_face(int v) const {
    for (const int f : map_.faces_of_vertex()[v])
        if (map_.is_mapped(f) && map_.image_triangle(f).D <= 0) return true;
    return false;
}

bool LocalRelaxation::try_walk(int v, const Vec3& step, double before, const FoldEnergy& energy) {
    const SurfacePoint old = map_.point(v);
    map_.move(v, step);
    if (total_energy(map_, map_.faces_of_vertex()[v], energy, before) < before) return true;
    map_.place(v, old);
    return false;
}

void LocalRelaxation::newton_step(int v, const FoldEnergy& energy) {
    const auto frame = map_.tangents(v);
    Quadratic quadratic;
    for (const int f : map_.faces_of_vertex()[v])
        if (map_.is_mapped(f)) add_face(quadratic, map_, frame, f, v, energy);
    Vec3 step = frame * descent(quadratic);
    const double length = step.norm(), limit = longest_step * std::sqrt(quadratic.squared_longest_edge);
    if (!(length > 1e-12)) return;
    if (length > limit) step *= limit / length;
    for (int i = 0; i <= backtracks; ++i, step /= 2)
        if (try_walk(v, step, quadratic.value, energy)) return;
}

void LocalRelaxation::leap_to_mean(int v, const FoldEnergy& energy) {
    Vec3 mean = Vec3::Zero();
    int count = 0;
    for (const int f : map_.faces_of_vertex()[v])
        for (int k = 0; k < 3; ++k) {
            const int other = map_.source().faces(f, k);
            if (other == v || !map_.has_image(other)) continue;
            mean += map_.image(other);
            ++count;
        }
    if (count == 0) return;
    const Vec3 step = mean / count - map_.image(v);
    const double before = total_energy(map_, map_.faces_of_vertex()[v], energy);
    for (const double share : {1.0, 0.5, 0.25, 2.0})
        if (try_walk(v, share * step, before, energy)) return;
}

}  // namespace varimap
