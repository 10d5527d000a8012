#include "varimap/geodesics/geodesic.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "varimap/geodesics/triangle_strip.h"
#include "varimap/mesh/topology.h"

namespace varimap {

namespace {

using FaceList = std::vector<int>;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double on_boundary = 1e-12;  ///< a barycentric coordinate below this lies on the opposite edge

/// What one thread needs for its queries. Entries of an earlier query are recognised by their stamp.
struct Scratch {
    struct Entry {
        unsigned stamp = 0;
        bool closed = false;
        int parent = -1;       ///< the node before, -1 for the start
        int parent_face = -1;  ///< the face between
        double distance = 0;
    };
    std::vector<Entry> entries;                ///< per node; the last one is the goal
    std::vector<std::pair<double, int>> heap;  ///< bound on the length of a path through the node, node
    unsigned stamp = 0;

    void start(size_t entry_count) {
        entries.resize(entry_count);
        heap.clear();
        ++stamp;
    }
    void reach(int node, double distance, double to_goal, int parent, int parent_face) {
        Entry& entry = entries[node];
        if (entry.stamp == stamp && entry.distance <= distance) return;
        entry = {stamp, false, parent, parent_face, distance};
        heap.emplace_back(distance + to_goal, node);
        std::push_heap(heap.begin(), heap.end(), std::greater<>());
    }
    /// Closes and returns the node with the lowest bound; -1 when there is none.
    int closest() {
        while (!heap.empty()) {
            std::pop_heap(heap.begin(), heap.end(), std::greater<>());
            const int node = heap.back().second;
            heap.pop_back();
            if (!std::exchange(entries[node].closed, true)) return node;
        }
        return -1;
    }
};

}  // namespace

struct Geodesic::State {
    const TriangleMesh mesh;
    const Edges edges;
    const Adjacency faces_of_vertex;
    std::vector<int> first_node;  ///< per edge, and one past the end
    std::vector<int> edge_of_node;
    Points node_position;
    mutable tbb::enumerable_thread_specific<Scratch> scratch;

    State(const TriangleMesh& m, int points_per_edge)
        : mesh(m), edges(find_edges(mesh)), faces_of_vertex(vertex_faces(mesh)) {
        spread_nodes(points_per_edge);
    }

    void spread_nodes(int points_per_edge);
    FaceList faces_around(const SurfacePoint& p) const;
    double shortest(const Vec3& a, const FaceList& a_faces, const Vec3& b, const FaceList& b_faces) const;
    double straightened(const Scratch& s, const Vec3& a, const Vec3& b) const;
};

void Geodesic::State::spread_nodes(int points_per_edge) {
    std::vector<double> lengths;
    for (const auto& [a, b] : edges.vertices) lengths.push_back((mesh.vertex(b) - mesh.vertex(a)).norm());
    const double total = std::accumulate(lengths.begin(), lengths.end(), 0.);
    const double per_length = total > 0 ? points_per_edge * double(lengths.size()) / total : 0;
    first_node.assign(1, 0);
    for (double length : lengths) {
        const double wanted = std::clamp(per_length * length, 1., 8. * points_per_edge);
        first_node.push_back(first_node.back() + int(std::lround(wanted)));
    }
    node_position.resize(first_node.back(), 3);
    edge_of_node.resize(first_node.back());
    for (int e = 0; e < int(edges.vertices.size()); ++e) {
        const int count = first_node[e + 1] - first_node[e];
        for (int j = 0; j < count; ++j) {
            const double t = (j + .5) / count;
            edge_of_node[first_node[e] + j] = e;
            node_position.row(first_node[e] + j) = (1 - t) * mesh.vertices.row(edges.vertices[e][0]) +
                                                   t * mesh.vertices.row(edges.vertices[e][1]);
        }
    }
}

/// The faces whose closure holds the point: one, those at its edge, or those at its vertex.
FaceList Geodesic::State::faces_around(const SurfacePoint& p) const {
    int zeros = 0, zero = 0, largest = 0;
    for (int k = 0; k < 3; ++k) {
        if (p.barycentric[k] < on_boundary) ++zeros, zero = k;
        if (p.barycentric[k] > p.barycentric[largest]) largest = k;
    }
    FaceList faces;
    if (zeros >= 2) {
        for (int f : faces_of_vertex[mesh.faces(p.face, largest)]) faces.push_back(f);
    } else if (zeros == 1) {
        for (int half_edge : edges.half_edges[edges.of_half_edge[3 * p.face + (zero + 1) % 3]])
            faces.push_back(half_edge / 3);
    } else {
        faces.push_back(p.face);
    }
    return faces;
}

/// A* over the edge points; a and b share no face.
double Geodesic::State::shortest(const Vec3& a, const FaceList& a_faces, const Vec3& b,
                                 const FaceList& b_faces) const {
    Scratch& s = scratch.local();
    const int goal = int(edge_of_node.size());
    s.start(goal + 1);
    const auto point = [&](int node) -> Vec3 { return node_position.row(node).transpose(); };
    const auto reach_face = [&](int f, const Vec3& from, double distance, int parent, int skipped_edge) {
        for (int half_edge = 3 * f; half_edge < 3 * f + 3; ++half_edge) {
            const int e = edges.of_half_edge[half_edge];
            if (e == skipped_edge) continue;
            for (int node = first_node[e]; node < first_node[e + 1]; ++node) {
                const Vec3 p = point(node);
                s.reach(node, distance + (p - from).norm(), (b - p).norm(), parent, f);
            }
        }
        if (std::find(b_faces.begin(), b_faces.end(), f) != b_faces.end())
            s.reach(goal, distance + (b - from).norm(), 0, parent, f);
    };
    for (int f : a_faces) reach_face(f, a, 0, -1, -1);
    for (int node = s.closest(); node >= 0; node = s.closest()) {
        if (node == goal) return straightened(s, a, b);
        const auto [stamp, closed, parent, parent_face, distance] = s.entries[node];
        for (int half_edge : edges.half_edges[edge_of_node[node]])
            if (half_edge / 3 != parent_face)
                reach_face(half_edge / 3, point(node), distance, node, edge_of_node[node]);
    }
    return infinity;
}

/// Length of the shortest path near the one that the search found.
double Geodesic::State::straightened(const Scratch& s, const Vec3& a, const Vec3& b) const {
    TriangleStrip strip;
    for (int node = int(edge_of_node.size()); node >= 0; node = s.entries[node].parent) {
        strip.faces.push_back(s.entries[node].parent_face);
        if (node < int(edge_of_node.size())) strip.edges.push_back(edge_of_node[node]);
    }
    std::reverse(strip.faces.begin(), strip.faces.end());
    std::reverse(strip.edges.begin(), strip.edges.end());
    return std::max(straighten(mesh, edges, strip, a, b).length, (b - a).norm());
}

Geodesic::Geodesic(const TriangleMesh& mesh, int points_per_edge)
    : state_(std::make_unique<State>(mesh, points_per_edge)) {}
Geodesic::~Geodesic() = default;
Geodesic::Geodesic(Geodesic&&) noexcept = default;

double Geodesic::operator()(const SurfacePoint& a, const SurfacePoint& b) const {
    const auto key = [](const SurfacePoint& p) {
        return std::tuple(p.face, p.barycentric[0], p.barycentric[1], p.barycentric[2]);
    };
    if (key(b) < key(a)) return (*this)(b, a);
    const Vec3 from = position(state_->mesh, a), to = position(state_->mesh, b);
    const auto a_faces = state_->faces_around(a), b_faces = state_->faces_around(b);
    const bool share_a_face =
        std::find_first_of(a_faces.begin(), a_faces.end(), b_faces.begin(), b_faces.end()) != a_faces.end();
    return share_a_face ? (to - from).norm() : state_->shortest(from, a_faces, to, b_faces);
}

}  // namespace varimap
