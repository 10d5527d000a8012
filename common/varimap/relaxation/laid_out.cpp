#include "varimap/relaxation/laid_out.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "varimap/mesh/triangle_strip.h"

namespace varimap {

namespace {

constexpr int farthest = 2000;  ///< faces that are looked at for a way

/// Twice the area of the triangle of `from` and two others, as seen from there.
double twice_area(const TriangleMesh& mesh, const SurfacePoint& from, const Vec3& right, const Vec3& left) {
    return face_normal(mesh, from.face).normalized().dot(right.cross(left));
}

}  // namespace

std::pair<Vec3, Vec3> LaidOut::headings(const SurfacePoint& a, const SurfacePoint& b) const {
    TriangleStrip strip = find_strip(mesh_, edges_, a.face, b.face, farthest);
    if (strip.faces.empty()) return {Vec3::Zero(), Vec3::Zero()};
    const Vec3 start = position(mesh_, a), goal = position(mesh_, b);
    straighten(mesh_, edges_, strip, start, goal);
    const Vec3 there = heading(mesh_, edges_, strip, start, goal);
    std::reverse(strip.faces.begin(), strip.faces.end());
    std::reverse(strip.edges.begin(), strip.edges.end());
    return {there, heading(mesh_, edges_, strip, goal, start)};
}

double LaidOut::sense(const std::array<SurfacePoint, 3>& corners) const {
    std::array<Vec3, 3> ahead, back;  // from each corner to the next, and from that one back
    for (std::size_t k = 0; k < 3; ++k)
        std::tie(ahead[k], back[k]) = headings(corners[k], corners[(k + 1) % 3]);
    double sum = 0, size = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double twice = twice_area(mesh_, corners[k], ahead[k], back[(k + 2) % 3]);
        sum += twice;
        size += std::abs(twice);
    }
    return sum / size;
}

}  // namespace varimap
