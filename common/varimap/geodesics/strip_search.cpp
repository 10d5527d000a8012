#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "varimap/geodesics/triangle_strip.h"
#include "varimap/mesh/face_geometry.h"

namespace varimap {

namespace {

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
        for (int half_edge = 3 * face; half_edge < 3 * face + 3; ++half_edge) {
            const int edge = edges.of_half_edge[std::size_t(half_edge)];
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

namespace {

/// A search for find_strip, from face to face by the lengths of ways through their centres, those first that
/// may lead to the goal soonest (A*).
class StripSearch {
  public:
    StripSearch(const TriangleMesh& mesh, const Edges& edges, int from, int to, double longest_detour)
        : mesh_(mesh),
          edges_(edges),
          to_(to),
          goal_(centroid(mesh, to)),
          reached_(reached_faces()),
          open_(open_ways()) {
        const Vec3 start = centroid(mesh, from);
        const double straight = (start - goal_).norm();
        longest_ = longest_detour * (straight + std::max(longest_edge(mesh, from), longest_edge(mesh, to)));
        open_way({straight, from, reached_.add({from, 0, -1, -1, start, 0})});
    }

    /// After `most` faces at most; empty where none was found by then.
    TriangleStrip run(int most) {
        for (int settled = 0; !open_.empty() && settled < most;) {
            std::pop_heap(open_.begin(), open_.end());
            if (open_.back().length > longest_) break;
            const int here = open_.back().number;
            open_.pop_back();
            if (std::exchange(reached_[here].settled, true)) continue;
            ++settled;
            if (reached_[here].face == to_) return strip_to(reached_, here);
            go_on_from(here);
        }
        return {};
    }

  private:
    /// Memory that searches of a thread have in common.
    static ReachedFaces& reached_faces() {
        thread_local ReachedFaces reached;
        reached.clear();
        return reached;
    }
    static std::vector<OpenWay>& open_ways() {
        thread_local std::vector<OpenWay> open;
        open.clear();
        return open;
    }

    void open_way(const OpenWay& way) {
        open_.push_back(way);
        std::push_heap(open_.begin(), open_.end());
    }

    void go_on_from(int here) {
        const int f = reached_[here].face;
        for (int half_edge = 3 * f; half_edge < 3 * f + 3; ++half_edge) {
            const int edge = edges_.of_half_edge[std::size_t(half_edge)];
            for (const int beyond : edges_.half_edges[edge])
                if (beyond / 3 != f) go_on(here, edge, beyond / 3);
        }
    }

    void go_on(int here, int edge, int g) {
        int there = reached_.find(g);
        const bool is_new = there < 0;
        if (is_new) {
            const Vec3 middle = centroid(mesh_, g);
            there = reached_.add({g, 0, edge, here, middle, (middle - goal_).norm()});
        }
        Reached& next = reached_[there];
        const double through = reached_[here].length + (next.centre - reached_[here].centre).norm();
        if (!is_new && next.length <= through) return;
        next.length = through, next.edge = edge, next.before = here, next.settled = false;
        open_way({through + next.to_goal, g, there});
    }

    const TriangleMesh& mesh_;
    const Edges& edges_;
    const int to_;
    const Vec3 goal_;
    ReachedFaces& reached_;
    std::vector<OpenWay>& open_;  ///< a heap
    double longest_;
};

}  // namespace

TriangleStrip find_strip(const TriangleMesh& mesh, const Edges& edges, int from, int to, int most,
                         double detour) {
    if (from == to) return {{from}, {}};
    for (int half_edge = 3 * from; half_edge < 3 * from + 3; ++half_edge)  // most ways are that short
        for (const int beyond : edges.half_edges[edges.of_half_edge[std::size_t(half_edge)]])
            if (beyond / 3 == to) return {{from, to}, {edges.of_half_edge[std::size_t(half_edge)]}};
    return StripSearch(mesh, edges, from, to, detour).run(most);
}

}  // namespace varimap
