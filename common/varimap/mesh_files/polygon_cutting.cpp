#include "varimap/mesh_files/polygon_cutting.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <span>

#include "varimap/core/plane.h"

namespace varimap {
namespace {

using CornerTriangle = std::array<std::size_t, 3>;

/// Finding ears takes the square of the corners, at worst the cube.
constexpr std::size_t most_corners = 4000;

std::vector<CornerTriangle> fan(std::size_t n) {
    std::vector<CornerTriangle> triangles;
    for (std::size_t k = 1; k + 1 < n; ++k) triangles.push_back({0, k, k + 1});
    return triangles;
}

/// Of each triangle of a fan twice the area, as a vector.
std::vector<Vec3> fan_areas(const std::vector<Vec3>& x) {
    std::vector<Vec3> areas;
    for (std::size_t k = 1; k + 1 < x.size(); ++k) areas.push_back((x[k] - x[0]).cross(x[k + 1] - x[0]));
    return areas;
}

bool folds(const std::vector<Vec3>& areas, const Vec3& area) {
    constexpr double rounding = 1e-9;
    return std::any_of(areas.begin(), areas.end(),
                       [&](const Vec3& a) { return a.dot(area) < -rounding * area.squaredNorm(); });
}

/// A polygon of the plane, counter-clockwise, from which ears are cut.
class EarCutter {
  public:
    explicit EarCutter(std::vector<Vec2> corners) : corners_(std::move(corners)), left_(corners_.size()) {
        std::iota(left_.begin(), left_.end(), 0u);
    }

    /// Nothing where it cannot be cut to the end.
    std::vector<CornerTriangle> run() {
        std::vector<CornerTriangle> triangles;
        for (std::size_t at = 0, in_vain = 0; left_.size() > 3;) {
            if (in_vain == left_.size()) return {};
            at %= left_.size();
            const CornerTriangle ear = corner(at);
            if (!is_ear(ear)) {
                ++at, ++in_vain;
                continue;
            }
            triangles.push_back(ear);
            left_.erase(left_.begin() + std::ptrdiff_t(at));
            ++at, in_vain = 0;  // the next ear not beside this one: rounder triangles
        }
        triangles.push_back({left_[0], left_[1], left_[2]});
        return triangles;
    }

  private:
    CornerTriangle corner(std::size_t at) const {
        return {left_[at > 0 ? at - 1 : left_.size() - 1], left_[at], left_[(at + 1) % left_.size()]};
    }
    double turn(std::size_t a, std::size_t b, std::size_t c) const {
        return cross(Vec2(corners_[b] - corners_[a]), Vec2(corners_[c] - corners_[a]));
    }
    bool is_ear(const CornerTriangle& ear) const {
        const auto [a, b, c] = ear;
        if (turn(a, b, c) <= 0) return false;
        return std::none_of(left_.begin(), left_.end(), [&](std::size_t p) {
            if (p == a || p == b || p == c || corners_[p] == corners_[a] || corners_[p] == corners_[c])
                return false;
            return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
        });
    }

    std::vector<Vec2> corners_;
    std::vector<std::size_t> left_;
};

std::vector<CornerTriangle> cut(const std::vector<Vec3>& x) {
    const std::vector<Vec3> areas = fan_areas(x);
    const Vec3 area = std::accumulate(areas.begin(), areas.end(), Vec3(Vec3::Zero()));
    if (x.size() > most_corners || !folds(areas, area)) return fan(x.size());
    const Vec3 normal = area.stableNormalized(), across = normal.unitOrthogonal(), up = normal.cross(across);
    std::vector<Vec2> flat;
    for (const Vec3& p : x) flat.emplace_back((p - x[0]).dot(across), (p - x[0]).dot(up));
    std::vector<CornerTriangle> triangles = EarCutter(std::move(flat)).run();
    return triangles.empty() ? fan(x.size()) : triangles;
}

}  // namespace

std::vector<CornerTriangle> triangle_corners(const PolygonSoup& soup) {
    std::vector<CornerTriangle> result;
    result.reserve(soup.corners.size() - 2 * soup.ends.size());
    std::size_t first = 0;
    std::vector<Vec3> polygon;
    for (const std::size_t end : soup.ends) {
        polygon.clear();
        if (end - first > 3)
            for (std::size_t c = first; c < end; ++c)
                polygon.push_back(soup.points[std::size_t(soup.corners[c])]);
        for (const auto& [a, b, c] : polygon.empty() ? fan(end - first) : cut(polygon))
            result.push_back({first + a, first + b, first + c});
        first = end;
    }
    return result;
}

}  // namespace varimap
