#include "varimap/mesh_repair/private/short_cycles.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>

#include "varimap/mesh/disjoint_sets.h"

namespace varimap {
namespace {

Adjacency edges_of_vertices(const Edges& edges, int vertices) {
    Adjacency result;
    result.begin.assign(std::size_t(vertices) + 1, 0);
    for (const auto& ends : edges.vertices)
        for (const int v : ends) ++result.begin[std::size_t(v) + 1];
    for (int v = 0; v < vertices; ++v) result.begin[std::size_t(v) + 1] += result.begin[std::size_t(v)];
    result.item.resize(2 * edges.vertices.size());
    std::vector<int> at(result.begin.begin(), result.begin.end() - 1);
    for (int e = 0; e < edges.size(); ++e)
        for (const int v : edges.vertices[std::size_t(e)]) result.item[std::size_t(at[std::size_t(v)]++)] = e;
    return result;
}

}  // namespace

ShortCycles::ShortCycles(const TriangleMesh& mesh, const Edges& edges, double unit)
    : mesh_(mesh),
      edges_(edges),
      vertex_edges_(edges_of_vertices(edges, mesh.vertex_count())),
      distance_(std::size_t(mesh.vertex_count()), nowhere),
      up_(std::size_t(mesh.vertex_count()), -1),
      face_number_(std::size_t(mesh.face_count()), 0) {
    for (const auto& [a, b] : edges.vertices)
        edge_length_.push_back(std::llround(1e6 * (mesh.vertex(a) - mesh.vertex(b)).norm() / unit));
}

int ShortCycles::other_end(int edge, int vertex) const {
    const auto [a, b] = edges_.vertices[std::size_t(edge)];
    return a == vertex ? b : a;
}

/// Dijkstra's shortest paths; among equals the lowest vertex first.
void ShortCycles::grow(int seed, Length radius) {
    using Entry = std::pair<Length, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    distance_[std::size_t(seed)] = 0;
    up_[std::size_t(seed)] = -1;
    queue.emplace(0, seed);
    reached_.clear();
    while (!queue.empty()) {
        const auto [distance, v] = queue.top();
        queue.pop();
        if (distance != distance_[std::size_t(v)]) continue;
        reached_.emplace_back(v, distance);
        for (const int e : vertex_edges_[v]) {
            const int w = other_end(e, v);
            const Length there = distance + edge_length_[std::size_t(e)];
            Length& known = distance_[std::size_t(w)];
            // An edge without length must not lead back to where it came from.
            if (there > radius || (known != nowhere && there >= known)) continue;
            known = there;
            up_[std::size_t(w)] = e;
            queue.emplace(there, w);
        }
    }
}

/// The number in the region of the face that a half-edge runs along, or 0.
int ShortCycles::region_face(int half_edge) const {
    return face_number_[std::size_t(half_edge / 3)];
}

void ShortCycles::collect_edges() {
    region_edges_.clear();
    region_faces_.clear();
    for (const auto& [v, distance] : reached_)
        for (const int e : vertex_edges_[v]) {
            const auto [a, b] = edges_.vertices[std::size_t(e)];
            if (a != v || !is_reached(b)) continue;
            region_edges_.push_back(e);
            for (const int half_edge : edges_.half_edges[e]) {
                const int f = half_edge / 3, apex = mesh_.faces(f, (half_edge % 3 + 2) % 3);
                if (!is_reached(apex) || face_number_[std::size_t(f)] > 0) continue;
                region_faces_.push_back(f);
                face_number_[std::size_t(f)] = int(region_faces_.size());
            }
        }
}

/// What is left of the edges between two spanning trees: the shortest paths, and, across the edges that close
/// the longest ways, one of the faces and the outside. Where the region is a disc, none.
std::vector<int> ShortCycles::closing_edges() {
    if (int(reached_.size()) - int(region_edges_.size()) + int(region_faces_.size()) == 1) return {};
    std::vector<std::pair<Length, int>> ways;
    for (const int e : region_edges_) {
        const auto [a, b] = edges_.vertices[std::size_t(e)];
        if (up_[std::size_t(a)] == e || up_[std::size_t(b)] == e) continue;
        ways.emplace_back(
            -(distance_[std::size_t(a)] + distance_[std::size_t(b)] + edge_length_[std::size_t(e)]), e);
    }
    std::sort(ways.begin(), ways.end());
    DisjointSets sets(1 + int(region_faces_.size()));
    std::vector<int> closing;
    for (const auto& [way, e] : ways) {
        const auto half_edges = edges_.half_edges[e];
        const int here = region_face(half_edges[0]),
                  there = half_edges.size() > 1 ? region_face(half_edges[1]) : 0;
        if (sets.lowest(here) == sets.lowest(there))
            closing.push_back(e);
        else
            sets.join(here, there);
    }
    return closing;
}

/// Both ways up from the edge, to where they meet.
Cycle ShortCycles::closed_by(int edge) const {
    auto [a, b] = edges_.vertices[std::size_t(edge)];
    Cycle cycle{edge_length_[std::size_t(edge)], {}};
    const auto path = [&](int v) {
        std::vector<int> vertices{v};
        while (up_[std::size_t(v)] >= 0) vertices.push_back(v = other_end(up_[std::size_t(v)], v));
        return vertices;
    };
    std::vector<int> from_a = path(a), from_b = path(b);
    while (from_a.size() > 1 && from_b.size() > 1 && from_a[from_a.size() - 2] == from_b[from_b.size() - 2]) {
        from_a.pop_back();
        from_b.pop_back();
    }
    const Length apex = distance_[std::size_t(from_a.back())];
    cycle.length += distance_[std::size_t(a)] + distance_[std::size_t(b)] - 2 * apex;
    from_b.pop_back();
    cycle.vertices = std::move(from_a);
    cycle.vertices.insert(cycle.vertices.end(), from_b.rbegin(), from_b.rend());
    return cycle;
}

void ShortCycles::forget() {
    for (const auto& [v, distance] : reached_) distance_[std::size_t(v)] = nowhere;
    for (const int f : region_faces_) face_number_[std::size_t(f)] = 0;
}

std::vector<Cycle> ShortCycles::around(int seed, Length radius, Length longest) {
    grow(seed, radius);
    collect_edges();
    std::vector<Cycle> cycles;
    for (const int e : closing_edges())
        if (Cycle cycle = closed_by(e); cycle.length <= longest && cycle.vertices.size() > 2)
            cycles.push_back(std::move(cycle));
    forget();
    return cycles;
}

}  // namespace varimap
