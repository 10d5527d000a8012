#include "varimap/map_repair/star_kernels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "varimap/core/plane.h"

namespace varimap {

namespace {

constexpr int most_rounds = 5;
/// With one, 11 of 18 maps (odd rows of a list) end without a reversed face, with six 12 or 13.
constexpr int most_turns = 6;
/// Without a bound a skull's torn walls took 45 of 102 seconds of relaxation.
constexpr std::ptrdiff_t most_visits_for_room = 2000;
/// Stars of more faces are left as they are: their deepest point would take long to find.
constexpr std::ptrdiff_t largest_star = 64;
/// Sense from which on a face is upright beyond doubt. On 14 pairs .05 and .1 leave as few reversed, .3 more.
constexpr double enough = 0.1;

/// The points x with normal . x >= offset.
struct HalfPlane {
    Vec2 normal;  ///< of unit length
    double offset;
    double depth(const Vec2& x) const { return normal.dot(x) - offset; }
};

double least_depth(const std::vector<HalfPlane>& planes, const Vec2& x) {
    double least = std::numeric_limits<double>::infinity();
    for (const HalfPlane& plane : planes) least = std::min(least, plane.depth(x));
    return least;
}

/// The point equally deep in all three, and how deep; none where there is no such point, or many.
std::optional<Vec3> equally_deep(const HalfPlane& a, const HalfPlane& b, const HalfPlane& c) {
    Eigen::Matrix3d equations;
    equations << a.normal.transpose(), -1, b.normal.transpose(), -1, c.normal.transpose(), -1;
    if (std::abs(equations.determinant()) < 1e-9) return std::nullopt;
    return Vec3(equations.inverse() * Vec3(a.offset, b.offset, c.offset));
}

/// The point that lies deepest in all of them: equally deep in some three, and no less in the others. Among
/// such points it is the deepest, since the least depth is concave.
std::optional<Vec2> deepest(const std::vector<HalfPlane>& planes) {
    std::optional<Vec2> best;
    double depth = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < planes.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            for (std::size_t k = 0; k < j; ++k) {
                const auto point = equally_deep(planes[i], planes[j], planes[k]);
                if (!point || !((*point)[2] > depth)) continue;
                const Vec2 x = point->head<2>();
                if (least_depth(planes, x) < (*point)[2] - 1e-9 * (1 + std::abs((*point)[2]))) continue;
                best = x;
                depth = (*point)[2];
            }
    return best;
}

/// A little off corners and edges: there LogMap has no face's plane to see others in.
SurfacePoint within_its_face(SurfacePoint point) {
    constexpr double share = 1e-6;
    point.barycentric = (1 - share) * point.barycentric + Vec3::Constant(share / 3);
    return point;
}

}  // namespace

double StarKernels::wrong(int f) {
    const double sense = along_target_.sense(f);
    return std::isnan(sense) ? 1 + enough : std::max(0.0, enough - sense);
}

double StarKernels::wrong_around(int v) {
    double sum = 0;
    for (const int f : map_.faces_of_vertex()[v]) sum += wrong(f);
    return sum;
}

bool StarKernels::move_to_centre(int v, Aim aim) {
    const double before = wrong_around(v);
    if (before == 0 && aim == Aim::upright) return false;
    const SurfacePoint kept = map_.point(v), start = within_its_face(kept);
    const auto star = map_.faces_of_vertex()[v];
    if (std::ssize(star) > largest_star) return false;
    std::vector<HalfPlane> planes;
    for (const int f : star) {
        if (!map_.is_mapped(f)) return false;
        const int k = map_.corner_of(f, v);
        const auto seen = [&](int corner) {
            return log_map_(start, map_.point(map_.source().faces(f, corner % 3))).first;
        };
        const Vec2 from = seen(k + 1), edge = seen(k + 2) - from;
        const double length = edge.norm();
        if (!(length > 0)) return false;
        const Vec2 left = Vec2(-edge[1], edge[0]) / length;
        planes.push_back({left, left.dot(from)});
    }
    const std::optional<Vec2> centre = deepest(planes);
    if (!centre) return false;
    const int branch_points = along_target_.faults_around(v).branch_points;
    const Vec3 step = log_map_.in_space(start.face, *centre);
    for (const double share : {1.0, 0.5, 0.25, 0.125}) {
        map_.place(v, map_.walk(start, share * step));
        const double after = wrong_around(v);
        if ((aim == Aim::room ? after <= before : after < before * (1 - 1e-6)) &&
            along_target_.faults_around(v).branch_points <= branch_points)
            return true;
    }
    map_.place(v, kept);
    return false;
}

void StarKernels::centre(const std::vector<int>& faces, const std::vector<int>& free) {
    for (int turn = 0; turn < most_turns; ++turn) {
        turn_upright(faces, free);
        if (std::ranges::none_of(faces, [&](int f) { return wrong(f) > 0; })) return;
        visits_for_room_ += std::ssize(free);
        if (visits_for_room_ > most_visits_for_room) return;
        for (const int v : free) move_to_centre(v, Aim::room);
    }
}

void StarKernels::turn_upright(std::vector<int> faces, const std::vector<int>& free) {
    for (int round = 0; round < most_rounds && !faces.empty(); ++round) {
        for (const int v : vertices_of(map_.source(), std::exchange(faces, {}))) {
            if (!std::binary_search(free.begin(), free.end(), v) || !move_to_centre(v, Aim::upright))
                continue;
            const auto star = map_.faces_of_vertex()[v];
            faces.insert(faces.end(), star.begin(), star.end());
        }
    }
}

}  // namespace varimap
