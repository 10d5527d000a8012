#include "varimap/geodesics/triangle_strip.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "varimap/core/plane.h"
#include "varimap/geodesics/funnel.h"
#include "varimap/mesh/face_geometry.h"

namespace varimap {

namespace {

/// A strip in the plane.
struct Unfolded {
    Vec2 start, goal;
    std::vector<Portal> portals;
    std::vector<std::pair<int, int>> ends;  ///< the vertices at the portals' left and right ends
};

/// Unfolds `p` into the plane, ahead (side 1) or behind (side -1) the portal whose ends are l and r in space.
Vec2 unfold(const Vec3& p, const Vec3& l, const Vec3& r, const Portal& portal, double side) {
    const auto& [left, right] = portal;
    const double length = (r - l).norm();
    if (length == 0) return left + Vec2(0, side * (p - l).norm());
    const Vec3 axis = (r - l) / length;
    const double along = axis.dot(p - l);
    const double away = (p - l - along * axis).norm();
    const Vec2 u = (right - left) / length;
    return left + along * u + side * away * Vec2(-u[1], u[0]);
}

Unfolded unfold(const TriangleMesh& mesh, const Edges& edges, const TriangleStrip& strip, const Vec3& start,
                const Vec3& goal) {
    Unfolded flat;
    auto [l, r] = edges.vertices[strip.edges.front()];
    Portal portal(Vec2(0, 0), Vec2((mesh.vertex(r) - mesh.vertex(l)).norm(), 0));
    flat.start = unfold(start, mesh.vertex(l), mesh.vertex(r), portal, -1);
    for (int edge : strip.edges) {
        const auto [v, w] = edges.vertices[edge];
        const bool keeps_left = v == l || w == l, keeps_right = v == r || w == r;
        if (!keeps_left || !keeps_right) {
            const int apex = v == l || v == r ? w : v;
            const Vec2 point = unfold(mesh.vertex(apex), mesh.vertex(l), mesh.vertex(r), portal, 1);
            (keeps_left ? r : l) = apex;
            (keeps_left ? portal.second : portal.first) = point;
        }
        flat.portals.push_back(portal);
        flat.ends.emplace_back(l, r);
    }
    flat.goal = unfold(goal, mesh.vertex(l), mesh.vertex(r), portal, 1);
    return flat;
}

/// A strip in the plane and the shortest path through it. Of one face: no portals.
struct Way {
    Unfolded flat;
    FunnelPath path;
};

Way shortest_way(const TriangleMesh& mesh, const Edges& edges, const TriangleStrip& strip, const Vec3& start,
                 const Vec3& goal) {
    if (strip.edges.empty()) return {{}, {(goal - start).norm(), {}}};
    Way way{unfold(mesh, edges, strip, start, goal), {}};
    way.path = funnel(way.flat.start, way.flat.portals, way.flat.goal);
    return way;
}

/// From the first of some points to the next that is elsewhere.
template <class Iterator>
Vec2 first_step(Iterator begin, Iterator end) {
    const auto next = std::find_if(begin, end, [&](const Vec2& point) { return point != *begin; });
    return next == end ? Vec2(0, 0) : Vec2(*next - *begin);
}

/// A direction of the plane as one in space, in the plane of a face beside a portal, whose ends there are l
/// and r and whose third corner is `apex`; `side` 1: the face lies ahead of the portal, -1: behind.
Vec3 in_space(const Vec2& direction, const Portal& portal, const Vec3& l, const Vec3& r, const Vec3& apex,
              double side) {
    const Vec2 u = (portal.second - portal.first).normalized();
    const Vec3 along = (r - l).normalized(), away = apex - l;
    const Vec3 ahead = side * (away - along.dot(away) * along).normalized();
    return u.dot(direction) * along + cross(u, direction) * ahead;
}

/// The corner of a face that is neither of two.
int third_corner(const TriangleMesh& mesh, int f, int a, int b) {
    int k = 0;
    while (mesh.faces(f, k) == a || mesh.faces(f, k) == b) ++k;
    return mesh.faces(f, k);
}

StraightPath ends_of(const Way& way, const TriangleMesh& mesh, const TriangleStrip& strip, const Vec3& start,
                     const Vec3& goal) {
    if (strip.edges.empty()) return {way.path.length, goal - start, start - goal};
    const Unfolded& flat = way.flat;
    std::vector<Vec2> corners{flat.start};
    for (const auto& [portal, is_left] : way.path.bends) {
        const Portal& ends = flat.portals[std::size_t(portal)];
        corners.push_back(is_left ? ends.first : ends.second);
    }
    corners.push_back(flat.goal);
    const auto at = [&](const Vec2& direction, std::size_t portal, int face, double side) -> Vec3 {
        const auto [l, r] = flat.ends[portal];
        const int apex = third_corner(mesh, face, l, r);
        return in_space(direction, flat.portals[portal], mesh.vertex(l), mesh.vertex(r), mesh.vertex(apex),
                        side)
                   .normalized() *
               way.path.length;
    };
    return {way.path.length, at(first_step(corners.begin(), corners.end()), 0, strip.faces.front(), -1),
            at(first_step(corners.rbegin(), corners.rend()), flat.portals.size() - 1, strip.faces.back(), 1)};
}

/// The edge of a face at one of its vertices that is not `edge`.
int other_edge_at(const Edges& edges, int vertex, int face, int edge) {
    int other = -1;
    for (int half_edge = 3 * face; half_edge < 3 * face + 3; ++half_edge) {
        const int e = edges.of_half_edge[half_edge];
        const auto [a, b] = edges.vertices[e];
        if (e != edge && (a == vertex || b == vertex)) other = e;
    }
    return other;
}

/// Crosses, from `face`, the edge at `vertex` other than `edge`, and goes on around the vertex up to `last`.
/// Nothing where a boundary is in the way.
std::optional<TriangleStrip> walk_around(const Edges& edges, int vertex, int face, int edge, int last) {
    TriangleStrip walk;
    for (const int first = face; face != last;) {
        edge = other_edge_at(edges, vertex, face, edge);
        const int beyond = face_beyond(edges, edge, face);
        if (beyond < 0 || beyond == first) return {};
        face = beyond;
        walk.edges.push_back(edge);
        walk.faces.push_back(face);
    }
    return walk;
}

/// The strip that passes the vertex at which portal `bend` ends on its other side.
std::optional<TriangleStrip> pass_other_side(const Edges& edges, const TriangleStrip& strip, int vertex,
                                             int bend) {
    const auto touches = [&](int i) {
        const auto [a, b] = edges.vertices[strip.edges[i]];
        return a == vertex || b == vertex;
    };
    int begin = bend, end = bend + 1;  // the portals around the vertex
    while (begin > 0 && touches(begin - 1)) --begin;
    while (end < int(strip.edges.size()) && touches(end)) ++end;
    const auto walk = walk_around(edges, vertex, strip.faces[begin], strip.edges[begin], strip.faces[end]);
    if (!walk) return {};
    TriangleStrip other;
    const auto splice = [](auto& to, const auto& from, int cut, const auto& middle, int resume) {
        to.assign(from.begin(), from.begin() + cut);
        to.insert(to.end(), middle.begin(), middle.end());
        to.insert(to.end(), from.begin() + resume, from.end());
    };
    splice(other.edges, strip.edges, begin, walk->edges, end);
    splice(other.faces, strip.faces, begin + 1, walk->faces, end + 1);
    return other;
}

/// Whether there is surely no other way around a vertex, which lies on `edge` of `face`, unless its full
/// angle is less than `enough`: it is as much, or there is a boundary.
bool has_angle(const TriangleMesh& mesh, const Edges& edges, int vertex, int face, int edge, double enough) {
    double sum = 0;
    const int first = face;
    do {
        sum += corner_angle(mesh, face, vertex);
        edge = other_edge_at(edges, vertex, face, edge);
        if (edges.half_edges[edge].size() > 2) return false;
        face = face_beyond(edges, edge, face);
    } while (face >= 0 && face != first && sum < enough);
    return face < 0 || sum >= enough;
}

/// The vertex at the left or the right end of a portal.
int vertex_at(const Unfolded& flat, int portal, bool is_left) {
    const auto [left, right] = flat.ends[std::size_t(portal)];
    return is_left ? left : right;
}

/// Whether the way may be shorter past the vertex at an end of a portal on its other side. There, start and
/// goal lie as far from the vertex as they do now, and around it as far apart as is left of its full angle: a
/// straight way is the shorter one if it has the lesser half of the angle. Around a vertex of a full turn or
/// more no two ways are locally shortest, so that one that passes it without a bend is the only one.
bool may_be_shorter_past(const TriangleMesh& mesh, const Edges& edges, const TriangleStrip& strip,
                         const Way& way, int portal, bool is_left) {
    const int vertex = vertex_at(way.flat, portal, is_left);
    for (const auto& bend : way.path.bends)
        if (vertex_at(way.flat, bend.first, bend.second) == vertex) return true;
    const auto& [left, right] = way.flat.portals[std::size_t(portal)];
    const Vec2 corner = is_left ? left : right;
    const Vec2 to_start = way.flat.start - corner, to_goal = way.flat.goal - corner;
    const double half = way.path.bends.empty()
                            ? std::atan2(std::abs(cross(to_start, to_goal)), to_start.dot(to_goal))
                            : std::numbers::pi;
    constexpr double rounding = 1e-6;
    return !has_angle(mesh, edges, vertex, strip.faces[std::size_t(portal)], strip.edges[std::size_t(portal)],
                      2 * half + rounding);
}

/// By how much a path is longer than the segment between its ends if another one is looked for, that passes a
/// vertex on its other side. Of the 140,000 paths between neighbours' images on five pairs 36 are not the
/// shortest then (by paths along points of edges), 30 with 1.01, 65 with 1.1.
constexpr double least_detour = 1.03;

}  // namespace

double corner_angle(const TriangleMesh& mesh, int face, int vertex) {
    int k = 0;
    while (mesh.faces(face, k) != vertex) ++k;
    const Vec3 p = mesh.vertex(vertex), to_next = mesh.vertex(mesh.faces(face, (k + 1) % 3)) - p,
               to_last = mesh.vertex(mesh.faces(face, (k + 2) % 3)) - p;
    return angle_between(to_next, to_last);
}

StraightPath straight_path(const TriangleMesh& mesh, const Edges& edges, const TriangleStrip& strip,
                           const Vec3& start, const Vec3& goal) {
    return ends_of(shortest_way(mesh, edges, strip, start, goal), mesh, strip, start, goal);
}

StraightPath straighten(const TriangleMesh& mesh, const Edges& edges, TriangleStrip& strip, const Vec3& start,
                        const Vec3& goal) {
    Way way = shortest_way(mesh, edges, strip, start, goal);
    const double length_over_a_spike = least_detour * (goal - start).norm();
    const auto is_shorter_past = [&](int portal, bool is_left) {
        if (!may_be_shorter_past(mesh, edges, strip, way, portal, is_left)) return false;
        auto other = pass_other_side(edges, strip, vertex_at(way.flat, portal, is_left), portal);
        if (!other) return false;
        Way other_way = shortest_way(mesh, edges, *other, start, goal);
        if (!(other_way.path.length < way.path.length * (1 - 1e-12))) return false;
        strip = std::move(*other);
        way = std::move(other_way);
        return true;
    };
    const auto is_shorter_past_a_bend = [&] {
        for (const auto& [portal, is_left] : way.path.bends)
            if (is_shorter_past(portal, is_left)) return true;
        return false;
    };
    const auto is_shorter_past_a_spike = [&] {
        if (!(way.path.length > length_over_a_spike)) return false;
        for (int portal = 0; portal < int(strip.edges.size()); ++portal)
            if (is_shorter_past(portal, true) || is_shorter_past(portal, false)) return true;
        return false;
    };
    while (is_shorter_past_a_bend() || is_shorter_past_a_spike()) {
    }
    return ends_of(way, mesh, strip, start, goal);
}

}  // namespace varimap
