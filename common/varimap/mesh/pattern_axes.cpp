#include "varimap/mesh/pattern_axes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "varimap/mesh/closest_point.h"

namespace varimap {

namespace {

/// Mean distance of a few thousand faces' middles, mirrored, from the surface.
double asymmetry(const TriangleMesh& mesh, const ClosestPoint& closest, const Vec3& middle, int axis) {
    constexpr int most = 2000;
    const int step = std::max(1, mesh.face_count() / most);
    double sum = 0, weight = 0;
    for (int f = 0; f < mesh.face_count(); f += step) {
        Vec3 p = position(mesh, {f, Vec3::Constant(1 / 3.)});
        p[axis] = 2 * middle[axis] - p[axis];
        const double area = face_normal(mesh, f).norm();
        if (!std::isfinite(area) || !p.allFinite()) continue;
        sum += area * std::sqrt(closest(p).squared_distance);
        weight += area;
    }
    return weight > 0 ? sum / weight : 0;
}

}  // namespace

Vec3 projected_areas(const TriangleMesh& mesh) {
    Vec3 sum = Vec3::Zero();
    for (int f = 0; f < mesh.face_count(); ++f) sum += face_normal(mesh, f).cwiseAbs();
    return sum / 2;
}

int likely_up(const TriangleMesh& mesh) {
    constexpr int y = 1, z = 2;
    const Vec3 areas = projected_areas(mesh);
    // People seen from the side project almost as much as from the front: prefer the front.
    constexpr double preference = 1.1;
    if (areas[z] * preference >= areas.maxCoeff() && areas[z] >= areas[y]) return y;
    if (areas[y] * preference >= areas.maxCoeff()) return z;
    const Box box = bounding_box(mesh);
    const Vec3 extent = box.high - box.low;
    const auto stands_on_zero = [&](int axis) { return std::abs(box.low[axis]) < .05 * extent[axis]; };
    if (stands_on_zero(y) != stands_on_zero(z)) return stands_on_zero(y) ? y : z;
    return extent[y] < extent[z] ? y : z;
}

std::array<int, 3> pattern_axes(const TriangleMesh& mesh) {
    const int up = likely_up(mesh);
    const Box box = bounding_box(mesh);
    const Vec3 extent = box.high - box.low, middle = (box.low + box.high) / 2;
    std::array<int, 3> axes{(up + 1) % 3, (up + 2) % 3, up};
    if (extent[axes[0]] < extent[axes[1]]) std::swap(axes[0], axes[1]);
    const ClosestPoint closest(mesh);
    // Animals are longer than wide; people with their arms out are not, but then they are even.
    if (2 * asymmetry(mesh, closest, middle, axes[0]) < asymmetry(mesh, closest, middle, axes[1]))
        std::swap(axes[0], axes[1]);
    std::swap(axes[1], axes[2]);
    if (extent[axes[0]] < extent[axes[1]]) std::swap(axes[0], axes[1]);
    return axes;
}

}  // namespace varimap
