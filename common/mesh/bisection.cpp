#include "common/mesh/bisection.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <queue>
#include <vector>

#include "common/mesh/topology.h"
#include "common/stage/error.h"

namespace varimap {
namespace {

/// One edge waiting to be split. Lengths are compared on a logarithmic grid, so that rounding cannot reorder
/// edges of equal length.
struct Candidate {
    int length;        ///< on the grid
    int surroundings;  ///< on the grid: total squared length of the sides of the faces beside it
    int edge;

    bool operator<(const Candidate& other) const {
        if (length != other.length) return length < other.length;
        if (surroundings != other.surroundings) return surroundings < other.surroundings;
        return edge > other.edge;
    }
};

int on_grid(double squared) {
    return squared > 0 ? int(std::lround(4096 * std::log2(squared))) : -10'000'000;
}

class Bisector {
  public:
    Bisector(const TriangleMesh& mesh, double target_length);
    void run(std::size_t max_vertices);
    Bisection result() const;

  private:
    struct Edge {
        std::array<int, 2> vertices;
        std::array<int, 2> faces;  ///< the second is -1 on a boundary
    };
    struct Face {
        std::array<int, 3> vertices;
        std::array<int, 3> edges;  ///< edges[c] joins vertices[c] and vertices[c + 1]
        std::array<Vec3, 3> on_origin;
        int origin;
    };

    double squared_length(int e) const {
        return (points_[edges_[e].vertices[0]] - points_[edges_[e].vertices[1]]).squaredNorm();
    }
    void offer(int e);
    void split(int e);
    int split_face(int f, int e, int second_half, int tail);
    void mark_origins();

    std::vector<Vec3> points_;
    std::vector<Edge> edges_;
    std::vector<Face> faces_;
    std::vector<SurfacePoint> on_origin_;
    std::priority_queue<Candidate> queue_;
    double limit_;  ///< squared; edges that exceed the target by rounding only are kept
};

Bisector::Bisector(const TriangleMesh& mesh, double target_length)
    : limit_(target_length * target_length * (1 + 1e-9)) {
    for (int v = 0; v < mesh.vertex_count(); ++v) points_.push_back(mesh.vertex(v));
    const Edges edges = find_edges(mesh);
    for (int e = 0; e < edges.size(); ++e) {
        const auto sides = edges.sides[e];
        edges_.push_back({edges.vertices[e], {sides[0] / 3, sides.size() > 1 ? sides[1] / 3 : -1}});
    }
    for (int f = 0; f < mesh.face_count(); ++f) {
        Face face{{}, {}, {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}, f};
        for (int c = 0; c < 3; ++c) {
            face.vertices[c] = mesh.faces(f, c);
            face.edges[c] = edges.of_side[3 * f + c];
        }
        faces_.push_back(face);
    }
    mark_origins();
    for (int e = 0; e < edges.size(); ++e) offer(e);
}

/// Every vertex of the mesh before lies on the first face that uses it.
void Bisector::mark_origins() {
    on_origin_.resize(points_.size());
    for (int f = int(faces_.size()) - 1; f >= 0; --f)
        for (int c = 0; c < 3; ++c) on_origin_[faces_[f].vertices[c]] = {f, faces_[f].on_origin[c]};
}

void Bisector::offer(int e) {
    const double squared = squared_length(e);
    if (!(squared > limit_)) return;
    double surroundings = 0;
    for (const int f : edges_[e].faces)
        if (f >= 0)
            for (const int side : faces_[f].edges) surroundings += squared_length(side);
    queue_.push({on_grid(squared / limit_), on_grid(surroundings / limit_), e});
}

void Bisector::run(std::size_t max_vertices) {
    for (; !queue_.empty(); split(queue_.top().edge)) {
        if (points_.size() < max_vertices) continue;
        throw InputError(
            fmt::format("bisection to edges of at most {:.3g} needs more than max_vertices = {} vertices; "
                        "choose a larger target_edge_length or a larger max_vertices",
                        std::sqrt(limit_), max_vertices));
    }
}

/// Splits edge e at its midpoint: e keeps its first half, and is the only one in the queue that changes.
void Bisector::split(int e) {
    queue_.pop();
    const int midpoint = int(points_.size()), second_half = int(edges_.size());
    const auto [tail, head] = edges_[e].vertices;
    points_.push_back(0.5 * (points_[tail] + points_[head]));
    on_origin_.push_back({});
    edges_.push_back({{midpoint, head}, {-1, -1}});
    edges_[e].vertices = {tail, midpoint};
    std::vector<int> spokes;
    for (int i = 0; i < 2; ++i) {
        const int f = edges_[e].faces[i];
        if (f < 0) continue;
        edges_[second_half].faces[i] = int(faces_.size());
        spokes.push_back(split_face(f, e, second_half, tail));
    }
    offer(e);
    offer(second_half);
    for (const int spoke : spokes) offer(spoke);
}

/// Splits face f along the line from the midpoint of its side e to the corner opposite. f keeps the half at
/// `tail`; the other half is appended, with `second_half` for its part of e. Returns the edge between them.
int Bisector::split_face(int f, int e, int second_half, int tail) {
    const int side = faces_[f].edges[0] == e ? 0 : faces_[f].edges[1] == e ? 1 : 2;
    const int next = (side + 1) % 3, apex = (side + 2) % 3;
    const bool tail_first = faces_[f].vertices[side] == tail;
    const int midpoint = int(points_.size()) - 1, spoke = int(edges_.size()), g = int(faces_.size());
    const Vec3 on_origin = 0.5 * (faces_[f].on_origin[side] + faces_[f].on_origin[next]);
    faces_.push_back(faces_[f]);
    Face &at_tail = faces_[f], &at_head = faces_[g];
    edges_.push_back({{midpoint, at_tail.vertices[apex]}, {f, g}});

    const int head_corner = tail_first ? next : side, tail_corner = tail_first ? side : next;
    at_tail.vertices[head_corner] = at_head.vertices[tail_corner] = midpoint;
    at_tail.on_origin[head_corner] = at_head.on_origin[tail_corner] = on_origin;
    at_head.edges[side] = second_half;
    at_tail.edges[tail_first ? next : apex] = spoke;
    at_head.edges[tail_first ? apex : next] = spoke;
    auto& outer = edges_[at_head.edges[tail_first ? next : apex]].faces;
    outer[outer[0] == f ? 0 : 1] = g;
    if (on_origin_.back().face < 0) on_origin_.back() = {at_tail.origin, on_origin};
    return spoke;
}

Bisection Bisector::result() const {
    Bisection result;
    result.mesh.vertices.resize(points_.size(), 3);
    for (std::size_t v = 0; v < points_.size(); ++v) result.mesh.vertices.row(v) = points_[v].transpose();
    result.mesh.faces.resize(faces_.size(), 3);
    for (std::size_t f = 0; f < faces_.size(); ++f) {
        for (int c = 0; c < 3; ++c) result.mesh.faces(f, c) = faces_[f].vertices[c];
        result.origin.push_back(faces_[f].origin);
    }
    result.on_origin = on_origin_;
    return result;
}

}  // namespace

Bisection bisect_longest_edges(const TriangleMesh& mesh, double target_length, int max_vertices) {
    Bisector bisector(mesh, target_length);
    bisector.run(max_vertices);
    return bisector.result();
}

}  // namespace varimap
