#include "varimap/mesh/triangle_strip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "varimap/core/plane.h"
#include "varimap/mesh/face_geometry.h"

namespace varimap {

namespace {

using Vec2 = Eigen::Vector2d;

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

/// The other face of an edge; -1 on a boundary, and where it has more than two.
int face_beyond(const Edges& edges, int edge, int face) {
    const auto sides = edges.sides[edge];
    if (sides.size() != 2) return -1;
    return sides[0] / 3 == face ? sides[1] / 3 : sides[0] / 3;
}

/// Crosses, from `face`, the edge at `vertex` other than `edge`, and goes on around the vertex up to `last`.
/// Nothing where a boundary is in the way.
std::optional<TriangleStrip> walk_around(const Edges& edges, int vertex, int face, int edge, int last) {
    TriangleStrip walk;
    for (const int first = face; face != last;) {
        int next = -1;
        for (int side = 3 * face; side < 3 * face + 3; ++side) {
            const int e = edges.of_side[side];
            const auto [a, b] = edges.vertices[e];
            if (e != edge && (a == vertex || b == vertex)) next = e;
        }
        const int beyond = next < 0 ? -1 : face_beyond(edges, next, face);
        if (beyond < 0 || beyond == first) return {};
        edge = next, face = beyond;
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

Vec3 centroid(const TriangleMesh& mesh, int f) {
    return (mesh.vertex(mesh.faces(f, 0)) + mesh.vertex(mesh.faces(f, 1)) + mesh.vertex(mesh.faces(f, 2))) /
           3;
}

/// A face that the search for a strip has reached.
struct Reached {
    int face;
    double length;
    int edge, before;  ///< the edge to it, and which face reached lies on its other side; -1: the first
    Vec3 centre;
    double to_goal;  ///< from its centre
    bool settled = false;
};

/// What has been reached, by face: few of them, looked up often. Holds its memory for repeated use.
class ReachedFaces {
  public:
    void clear() {
        all_.clear();
        if (++search_ != 0) return;
        std::fill(slots_.begin(), slots_.end(), Slot{});  // the counter went round
        search_ = 1;
    }
    int size() const { return int(all_.size()); }
    Reached& operator[](int i) { return all_[std::size_t(i)]; }
    /// Its number, or -1.
    int find(int face) const {
        const Slot& slot = slots_[slot_of(face)];
        return slot.search == search_ ? slot.number : -1;
    }
    int add(const Reached& reached) {
        if (2 * (all_.size() + 1) > slots_.size()) grow();
        all_.push_back(reached);
        slots_[slot_of(reached.face)] = {search_, size() - 1};
        return size() - 1;
    }

  private:
    struct Slot {
        std::uint32_t search = 0;
        int number = -1;
    };
    /// Where the face is, or would be.
    std::size_t slot_of(int face) const {
        const std::size_t mask = slots_.size() - 1;
        std::size_t at = (std::uint32_t(face) * 2654435769u >> 7) & mask;
        while (slots_[at].search == search_ && all_[std::size_t(slots_[at].number)].face != face)
            at = (at + 1) & mask;
        return at;
    }
    void grow() {
        slots_.assign(2 * slots_.size(), {});
        for (int i = 0; i < size(); ++i) slots_[slot_of(all_[std::size_t(i)].face)] = {search_, i};
    }

    std::vector<Reached> all_;
    std::vector<Slot> slots_ = std::vector<Slot>(64);
    std::uint32_t search_ = 0;
};

TriangleStrip strip_to(ReachedFaces& reached, int last) {
    TriangleStrip strip;
    for (int i = last; i >= 0; i = reached[i].before) {
        strip.faces.push_back(reached[i].face);
        if (reached[i].before >= 0) strip.edges.push_back(reached[i].edge);
    }
    std::reverse(strip.faces.begin(), strip.faces.end());
    std::reverse(strip.edges.begin(), strip.edges.end());
    return strip;
}

/// A way through a face that was reached, and what it is at least as long as. The shortest comes first, among
/// equals that through the lowest face.
struct OpenWay {
    double length;
    int face, number;
    bool operator<(const OpenWay& other) const {
        return length != other.length ? length > other.length : face > other.face;
    }
};

/// A plane through two points, which a way between them follows: how far off it a vertex lies, and where it
/// crosses an edge, 0 at the one point and 1 at the other.
class Cut {
  public:
    Cut(const TriangleMesh& mesh, const Vec3& from, const Vec3& to, const Vec3& up)
        : mesh_(mesh), from_(from), along_(to - from), normal_(along_.cross(up)) {}

    bool is_plane() const { return normal_.squaredNorm() > 0; }
    /// Where it crosses an edge; nothing where it does not. A vertex lies on the same side of it for all
    /// faces.
    std::optional<double> crossing(const std::array<int, 2>& edge) const {
        const Vec3 a = mesh_.vertex(edge[0]) - from_, b = mesh_.vertex(edge[1]) - from_;
        const double off_a = normal_.dot(a), off_b = normal_.dot(b);
        if ((off_a < 0) == (off_b < 0)) return {};
        return along_.dot((off_b * a - off_a * b) / (off_b - off_a)) / along_.squaredNorm();
    }

  private:
    const TriangleMesh& mesh_;
    Vec3 from_, along_, normal_;
};

constexpr int most_straight = 64;  ///< faces of a straight strip
/// By how much a path is longer than the segment between its ends if another one is looked for, that passes a
/// vertex on its other side. Of the 140,000 paths between neighbours' images on five pairs 36 are not the
/// shortest then (by paths along points of edges), 30 with 1.01, 65 with 1.1.
constexpr double least_detour = 1.03;

}  // namespace

TriangleStrip straight_strip(const TriangleMesh& mesh, const Edges& edges, const SurfacePoint& from,
                             const SurfacePoint& to) {
    TriangleStrip strip{{from.face}, {}};
    if (from.face == to.face) return strip;
    const Cut cut(mesh, position(mesh, from), position(mesh, to),
                  face_normal(mesh, from.face).normalized() + face_normal(mesh, to.face).normalized());
    if (!cut.is_plane()) return {};
    double reached = 0;
    for (int step = 0; step < most_straight; ++step) {
        const int face = strip.faces.back();
        int exit = -1;
        double farthest = reached;
        for (int side = 3 * face; side < 3 * face + 3; ++side) {
            const int edge = edges.of_side[std::size_t(side)];
            if (const auto at = cut.crossing(edges.vertices[std::size_t(edge)]); at && *at > farthest) {
                exit = edge;
                farthest = *at;
            }
        }
        const int beyond = exit < 0 || farthest > 1 ? -1 : face_beyond(edges, exit, face);
        if (beyond < 0) return {};
        reached = farthest;
        strip.edges.push_back(exit);
        strip.faces.push_back(beyond);
        if (beyond == to.face) return strip;
    }
    return {};
}

TriangleStrip find_strip(const TriangleMesh& mesh, const Edges& edges, int from, int to, int most,
                         double detour) {
    if (from == to) return {{from}, {}};
    for (int side = 3 * from; side < 3 * from + 3; ++side)  // most ways are that short
        for (const int beyond : edges.sides[edges.of_side[std::size_t(side)]])
            if (beyond / 3 == to) return {{from, to}, {edges.of_side[std::size_t(side)]}};
    thread_local ReachedFaces reached;
    thread_local std::vector<OpenWay> open;  // a heap
    reached.clear();
    open.clear();
    const Vec3 goal = centroid(mesh, to), start = centroid(mesh, from);
    const double longest =
        detour * ((start - goal).norm() + std::max(longest_edge(mesh, from), longest_edge(mesh, to)));
    const auto open_way = [](const OpenWay& way) {
        open.push_back(way);
        std::push_heap(open.begin(), open.end());
    };
    open_way({(start - goal).norm(), from, reached.add({from, 0, -1, -1, start, 0})});
    for (int settled = 0; !open.empty() && settled < most;) {
        std::pop_heap(open.begin(), open.end());
        if (open.back().length > longest) break;
        const int here = open.back().number;
        open.pop_back();
        if (std::exchange(reached[here].settled, true)) continue;
        ++settled;
        const int f = reached[here].face;
        if (f == to) return strip_to(reached, here);
        const double length = reached[here].length;
        const Vec3 from_here = reached[here].centre;
        for (int side = 3 * f; side < 3 * f + 3; ++side) {
            const int edge = edges.of_side[std::size_t(side)];
            for (const int beyond : edges.sides[edge]) {
                const int g = beyond / 3;
                if (g == f) continue;
                int there = reached.find(g);
                const bool is_new = there < 0;
                if (is_new) {
                    const Vec3 middle = centroid(mesh, g);
                    there = reached.add({g, 0, edge, here, middle, (middle - goal).norm()});
                }
                Reached& next = reached[there];
                const double through = length + (next.centre - from_here).norm();
                if (!is_new && next.length <= through) continue;
                next.length = through, next.edge = edge, next.before = here, next.settled = false;
                open_way({through + next.to_goal, g, there});
            }
        }
    }
    return {};
}

FunnelPath funnel(const Vec2& start, const std::vector<Portal>& portals, const Vec2& goal) {
    const int n = int(portals.size());
    FunnelPath path;
    Vec2 apex = start, left = start, right = start;
    int left_index = -1, right_index = -1;
    const auto bend_at = [&](const Vec2& corner, int index, bool is_left) {
        path.length += (corner - apex).norm();
        path.bends.emplace_back(index, is_left);
        apex = left = right = corner;
        left_index = right_index = index;
    };
    for (int i = 0; i <= n; ++i) {
        const auto [l, r] = i < n ? portals[i] : Portal(goal, goal);
        if (cross(right - apex, r - apex) >= 0) {  // the right side does not widen
            if (apex != right && left != r && cross(left - apex, r - apex) > 0) {
                i = left_index;
                bend_at(Vec2(left), left_index, true);
                continue;
            }
            right = r, right_index = i;
        }
        if (cross(left - apex, l - apex) <= 0) {
            if (apex != left && right != l && cross(right - apex, l - apex) < 0) {
                i = right_index;
                bend_at(Vec2(right), right_index, false);
                continue;
            }
            left = l, left_index = i;
        }
    }
    path.length += (goal - apex).norm();
    return path;
}

namespace {

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

}  // namespace

StraightPath straight_path(const TriangleMesh& mesh, const Edges& edges, const TriangleStrip& strip,
                           const Vec3& start, const Vec3& goal) {
    return ends_of(shortest_way(mesh, edges, strip, start, goal), mesh, strip, start, goal);
}

StraightPath straighten(const TriangleMesh& mesh, const Edges& edges, TriangleStrip& strip, const Vec3& start,
                        const Vec3& goal) {
    Way way = shortest_way(mesh, edges, strip, start, goal);
    const double length_over_a_spike = least_detour * (goal - start).norm();
    const auto is_shorter_past = [&](int portal, bool is_left) {
        const auto [left, right] = way.flat.ends[std::size_t(portal)];
        auto other = pass_other_side(edges, strip, is_left ? left : right, portal);
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
