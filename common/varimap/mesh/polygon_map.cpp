#include "varimap/mesh/polygon_map.h"

#include <algorithm>
#include <optional>

#include "varimap/core/index_set.h"
#include "varimap/core/plane.h"
#include "varimap/mesh/closest_point.h"
#include "varimap/mesh/disc.h"
#include "varimap/mesh/subdivision.h"

namespace varimap {

namespace {

using Polygon = std::vector<Vec2>;

constexpr double outside = 1e-9;  ///< of the polygon, whose size is about 1
constexpr int subdivisions = 2;   ///< of the ears: what is smooth in the circle is to be so in the polygon

Vec2 flat(const Points& points, int i) {
    return points.row(i).leftCols<2>().transpose();
}

double twice_area(const Vec2& a, const Vec2& b, const Vec2& c) {
    return cross(b - a, c - a);
}

bool holds(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& p) {
    return twice_area(a, b, p) >= 0 && twice_area(b, c, p) >= 0 && twice_area(c, a, p) >= 0;
}

/// Area by squared sides of the ear at position `i` of what is left of the polygon; not positive if it is
/// none.
double quality_of_ear(const Points& polygon, const std::vector<int>& left, std::size_t i) {
    const std::size_t n = left.size(), before = (i + n - 1) % n, after = (i + 1) % n;
    const Vec2 a = flat(polygon, left[before]), b = flat(polygon, left[i]), c = flat(polygon, left[after]);
    const double area = twice_area(a, b, c);
    if (!(area > 0)) return 0;
    for (std::size_t j = 0; j < n; ++j)
        if (j != before && j != i && j != after && holds(a, b, c, flat(polygon, left[j]))) return 0;
    return area / ((b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm());
}

/// The part of a convex polygon to the left of the line from `a` along `direction`.
Polygon cut_off(const Polygon& polygon, const Vec2& a, const Vec2& direction) {
    Polygon left;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        const double at_p = cross(direction, p - a), at_q = cross(direction, q - a);
        if (at_p >= 0) left.push_back(p);
        if ((at_p < 0) != (at_q < 0)) left.push_back(p + (q - p) * (at_p / (at_p - at_q)));
    }
    return left;
}

bool is_inside(const Polygon& convex, const Vec2& p) {
    for (std::size_t i = 0; i < convex.size(); ++i)
        if (!(twice_area(convex[i], convex[(i + 1) % convex.size()], p) > 0)) return false;
    return true;
}

/// Maps a convex polygon onto itself, the boundary pointwise, `from` to `to`, linear on every triangle with
/// `from` and a side. What lies outside stays.
struct FanMap {
    Polygon rim;
    Vec2 from, to;

    Vec2 operator()(const Vec2& p) const {
        if (!is_inside(rim, p)) return p;
        for (std::size_t i = 0; i < rim.size(); ++i) {
            const Vec2 &a = rim[i], &b = rim[(i + 1) % rim.size()];
            if (holds(from, a, b, p)) return p + (to - from) * (twice_area(p, a, b) / twice_area(from, a, b));
        }
        return p;
    }
};

/// Moves `from` to `to` in a convex polygon and leaves `kept` where they are: the fan lies between parallels
/// through them.
std::optional<FanMap> fan_between(Polygon rim, const Vec2& from, const Vec2& to,
                                  const std::vector<Vec2>& kept) {
    const Vec2 along = to - from;
    if (along.norm() > 0)
        for (const Vec2& p : kept) rim = cut_off(rim, p, cross(along, from - p) > 0 ? along : -along);
    if (!is_inside(rim, from) || !is_inside(rim, to)) return {};
    return FanMap{std::move(rim), from, to};
}

/// A polygon, triangulated, and the same in the circle.
struct InCircle {
    TriangleMesh polygon, circle;

    InCircle(const Points& corners, const Points& rim, const Faces& ears)
        : polygon{corners, ears}, circle{rim, ears} {
        for (int i = 0; i < subdivisions; ++i) {
            polygon = subdivide(polygon).mesh;
            circle = subdivide(circle).mesh;
        }
        const std::vector<int> boundary = disc_boundary(polygon);
        Points on_chords(Eigen::Index(boundary.size()), 3);
        for (std::size_t i = 0; i < boundary.size(); ++i)
            on_chords.row(Eigen::Index(i)) = circle.vertices.row(boundary[i]);
        circle.vertices = even_embedding(polygon, boundary, on_chords);
    }
};

/// Maps of the circle onto itself that take the pinned vertices from where they are to where they are to be,
/// one after the other; none if that cannot be.
std::optional<std::vector<FanMap>> fans_to(const std::vector<Vec2>& from, const std::vector<Vec2>& to,
                                           const Points& rim) {
    Polygon circle;
    for (int i = 0; i < rim.rows(); ++i) circle.push_back(flat(rim, i));
    std::vector<FanMap> fans;
    for (std::size_t k = 0; k < from.size(); ++k) {
        Vec2 present = from[k];
        for (const FanMap& fan : fans) present = fan(present);
        const std::vector<Vec2> kept(to.begin(), to.begin() + std::ptrdiff_t(k));
        std::optional<FanMap> fan = fan_between(circle, present, to[k], kept);
        if (!fan) return {};
        fans.push_back(std::move(*fan));
    }
    return fans;
}

}  // namespace

Faces cut_into_ears(const Points& polygon) {
    std::vector<int> left = all_indices(polygon.rows());
    Faces ears(std::max<Eigen::Index>(0, polygon.rows() - 2), 3);
    for (int count = 0; count < ears.rows(); ++count) {
        std::size_t best = 0;
        double best_quality = 0;
        for (std::size_t i = 0; i < left.size(); ++i)
            if (const double quality = quality_of_ear(polygon, left, i); quality > best_quality) {
                best = i;
                best_quality = quality;
            }
        if (best_quality == 0) return Faces(0, 3);
        const std::size_t n = left.size();
        ears.row(count) << left[(best + n - 1) % n], left[best], left[(best + 1) % n];
        left.erase(left.begin() + std::ptrdiff_t(best));
    }
    return ears;
}

Points map_onto_polygon(const TriangleMesh& chart, const std::vector<int>& boundary, const Points& polygon,
                        const std::vector<Pin>& pins) {
    const Faces ears = cut_into_ears(polygon);
    if (ears.rows() == 0) return {};
    const Points rim = chart.vertices(boundary, Eigen::all);
    const InCircle goal(polygon, rim, ears);
    const ClosestPoint in_circle(goal.circle), in_polygon(goal.polygon);
    std::vector<Vec2> from, to;
    for (const auto& [v, place] : pins) {
        const ClosestPoint::Hit hit = in_polygon(place);
        if (hit.squared_distance > outside * outside) return {};
        from.push_back(flat(chart.vertices, v));
        to.push_back(position(goal.circle, hit.point).head<2>());
    }
    const auto fans = fans_to(from, to, rim);
    if (!fans) return {};
    Points positions(chart.vertex_count(), 3);
    for (int v = 0; v < chart.vertex_count(); ++v) {
        Vec2 p = flat(chart.vertices, v);
        for (const FanMap& fan : *fans) p = fan(p);
        positions.row(v) = position(goal.polygon, in_circle(Vec3(p.x(), p.y(), 0)).point).transpose();
    }
    for (std::size_t i = 0; i < boundary.size(); ++i)
        positions.row(boundary[i]) = polygon.row(Eigen::Index(i));
    for (const auto& [v, place] : pins) positions.row(v) = place.transpose();
    return positions;
}

}  // namespace varimap
