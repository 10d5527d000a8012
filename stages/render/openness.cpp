#include "stages/render/openness.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "varimap/core/parallel.h"

namespace varimap {

namespace {

/// Point number i of n of a Hammersley set, its second coordinate shifted.
Eigen::Vector2d hammersley(unsigned i, unsigned n, double shift) {
    double inverse = 0, digit = .5;
    for (unsigned bits = i; bits; bits >>= 1, digit /= 2) inverse += (bits & 1) * digit;
    const double second = inverse + shift;
    return {(i + .5) / n, second - std::floor(second)};
}

}  // namespace

std::vector<double> ambient_openness(const TriangleMesh& mesh, const Points& normals, const RayMesh& rays,
                                     double reach) {
    constexpr double ray_budget = 5e5, lift = 2e-3;
    const auto count = unsigned(std::clamp(ray_budget / mesh.vertex_count(), 24., 48.));
    std::vector<double> openness(size_t(mesh.vertex_count()), 1);
    parallel_for_each_index(mesh.vertex_count(), 64, [&](int v) {
        const Vec3 n = normals.row(v).transpose();
        if (n.squaredNorm() == 0) return;
        const Vec3 t = n.unitOrthogonal(), b = n.cross(t);
        unsigned open = 0;
        for (unsigned i = 0; i < count; ++i) {
            const Eigen::Vector2d s = hammersley(i, count, v * std::numbers::phi);
            const double radius = std::sqrt(s[0]), angle = 2 * std::numbers::pi * s[1];
            const Vec3 direction =
                radius * (std::cos(angle) * t + std::sin(angle) * b) + std::sqrt(1 - s[0]) * n;
            open += !rays.is_blocked(mesh.vertex(v) + lift * n, direction, reach);
        }
        openness[size_t(v)] = double(open) / count;
    });
    return openness;
}

}  // namespace varimap
