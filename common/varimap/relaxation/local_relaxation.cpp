#include "varimap/relaxation/local_relaxation.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <utility>

#include "varimap/sliding/face_energy.h"

namespace varimap {

namespace {

constexpr int backtracks = 7;
constexpr double longest_newton_step = 2;  ///< in lengths of the vertex's longest source edge
/// Move, in those lengths, that wakes the neighbours. With 0.01 more faces stay reversed.
constexpr double waking_step = 0.003;

/// Newton's direction with the Hessian's eigenvalues made positive.
Eigen::Vector2d descent(const Star::Quadratic& quadratic) {
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen;
    eigen.computeDirect(quadratic.hessian);
    const Eigen::Vector2d size = eigen.eigenvalues().cwiseAbs();
    const double least = 1e-6 * size.maxCoeff();
    if (!(least > 0)) return Eigen::Vector2d::Zero();
    const Eigen::Vector2d along = eigen.eigenvectors().transpose() * quadratic.gradient;
    return -(eigen.eigenvectors() * along.cwiseQuotient(size.cwiseMax(least)));
}

}  // namespace

void Star::gather(const SlidingMap& map, int v) {
    faces_.clear();
    for (const int f : map.faces_of_vertex()[v]) {
        if (!map.is_mapped(f)) continue;
        const auto corners = map.source().faces.row(f);
        const int i = map.corner_of(f, v), j = (i + 1) % 3, k = (i + 2) % 3;
        const RestTriangle& rest = map.rest(f);
        faces_.push_back(
            {{rest.area, {rest.cotangent[i], rest.cotangent[j], rest.cotangent[k]}, rest.area_weight},
             map.image(corners[j]),
             map.image(corners[k]),
             map.normal(corners[j]) + map.normal(corners[k])});
    }
}

Star::Quadratic Star::quadratic(const Vec3& x, const Vec3& normal, const TangentFrame& frame,
                                const FoldEnergy& energy) const {
    Quadratic sum;
    for (const Face& face : faces_) {
        const RestTriangle& rest = face.rest;
        const ImageTriangle image = face.image(x, normal);
        const auto d = energy.with(rest.area_weight).derivatives(image.q, image.D);
        const double cj = rest.cotangent[1], ck = rest.cotangent[2];
        const CornerGradient gradient = corner_gradient(cj, ck, x, face.y, face.z, image.up);
        const Eigen::Vector2d q = frame.transpose() * gradient.q / rest.area;
        const Eigen::Vector2d D = frame.transpose() * gradient.D / (2 * rest.area);
        sum.value += rest.area * d.f;
        sum.has_reversed = sum.has_reversed || image.D <= 0;
        sum.gradient += rest.area * (d.f_q * q + d.f_D * D);
        sum.hessian += rest.area * gradient_products(q, D, d.f_qD, d.f_DD);
        sum.hessian.diagonal().array() += d.f_q * (cj + ck);
    }
    return sum;
}

double Star::energy(const Vec3& x, const Vec3& normal, const FoldEnergy& energy, double limit) const {
    double sum = 0;
    for (const Face& face : faces_) {
        if (sum >= limit) break;
        const ImageTriangle image = face.image(x, normal);
        sum += face.rest.area * energy.with(face.rest.area_weight).value(image.q, image.D);
    }
    return sum;
}

bool Star::has_reversed(const Vec3& x, const Vec3& normal) const {
    for (const Face& face : faces_)
        if (face.image(x, normal).D <= 0) return true;
    return false;
}

bool Star::mean_of_others(Vec3& mean) const {
    mean.setZero();
    for (const Face& face : faces_) mean += face.y + face.z;
    mean /= double(2 * faces_.size());
    return !faces_.empty();
}

void LocalRelaxation::sweep(std::vector<int>& vertices, const FoldEnergy& energy) {
    shuffle(vertices);
    for (const int v : vertices) {
        star_.gather(map_, v);
        newton_step(v, energy);
    }
}

void LocalRelaxation::sweep_awake(std::vector<int>& vertices, const FoldEnergy& energy,
                                  VertexData<bool>& awake) {
    shuffle(vertices);
    for (const int v : vertices) {
        if (!awake[v]) continue;
        awake[v] = false;
        const Vec3 before = map_.image(v);
        star_.gather(map_, v);
        newton_step(v, energy);
        if (star_.has_reversed(map_.image(v), map_.normal(v))) leap_to_mean(v, energy);
        if ((map_.image(v) - before).norm() > waking_step * map_.longest_edge(v)) wake_neighbours(v, awake);
    }
}

void LocalRelaxation::wake_neighbours(int v, VertexData<bool>& awake) const {
    for (const int f : map_.faces_of_vertex()[v]) mark_corners(map_.source(), f, awake);
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

/// Leaves the vertex where the walk led if that has less energy; else where it may be anything.
bool LocalRelaxation::try_walk(int v, const SurfacePoint& from, const Vec3& step, double before,
                               const FoldEnergy& energy) {
    map_.place(v, map_.walk(from, step));
    return star_.energy(map_.image(v), map_.normal(v), energy, before) < before && guard_.allows();
}

void LocalRelaxation::newton_step(int v, const FoldEnergy& energy) {
    const TangentFrame& frame = map_.tangents(v);
    const Star::Quadratic quadratic = star_.quadratic(map_.image(v), map_.normal(v), frame, energy);
    Vec3 step = frame * descent(quadratic);
    const double length = step.norm(), limit = longest_newton_step * map_.longest_edge(v);
    if (!(length > 1e-12)) return;
    if (length > limit) step *= limit / length;
    const SurfacePoint start = map_.point(v);
    guard_.rest();
    if (quadratic.has_reversed) guard_.watch(v);
    for (int i = 0; i <= backtracks; ++i, step /= 2)
        if (try_walk(v, start, step, quadratic.value, energy)) return;
    map_.place(v, start);
}

void LocalRelaxation::leap_to_mean(int v, const FoldEnergy& energy) {
    Vec3 mean;
    if (!star_.mean_of_others(mean)) return;
    const Vec3 step = mean - map_.image(v);
    const SurfacePoint start = map_.point(v);
    guard_.watch(v);
    const double before =
        star_.energy(map_.image(v), map_.normal(v), energy, std::numeric_limits<double>::infinity());
    for (const double share : {1.0, 0.5, 0.25, 2.0})
        if (try_walk(v, start, share * step, before, energy)) return;
    map_.place(v, start);
}

}  // namespace varimap
