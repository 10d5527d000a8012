#include "varimap/mesh/topology.h"

#include <algorithm>
#include <numeric>

#include "varimap/core/bucket_sort.h"
#include "varimap/core/index_set.h"
#include "varimap/mesh/boundary.h"
#include "varimap/mesh/disjoint_sets.h"

namespace varimap {
namespace {

struct HalfEdgeEnds {
    int low, high;  ///< the edge's vertices
    int half_edge;
};

/// By edge, those of one edge ascending.
std::vector<HalfEdgeEnds> half_edges_by_edge(const TriangleMesh& mesh) {
    const int count = 3 * mesh.face_count();
    const auto ends_of = [&](int h) {
        const int a = mesh.faces(h / 3, h % 3), b = mesh.faces(h / 3, (h + 1) % 3);
        return HalfEdgeEnds{std::min(a, b), std::max(a, b), h};
    };
    int vertices = 0;
    for (int h = 0; h < count; ++h) vertices = std::max(vertices, ends_of(h).low + 1);
    return sorted_in_buckets(
               count, vertices, ends_of, [](const HalfEdgeEnds& h) { return h.low; },
               [](const HalfEdgeEnds& x, const HalfEdgeEnds& y) {
                   return x.high != y.high ? x.high < y.high : x.half_edge < y.half_edge;
               })
        .item;
}

}  // namespace

Adjacency vertex_faces(const TriangleMesh& mesh) {
    Adjacency result;
    result.begin.assign(mesh.vertex_count() + 1, 0);
    for (int f = 0; f < mesh.face_count(); ++f)
        for (int c = 0; c < 3; ++c) ++result.begin[mesh.faces(f, c) + 1];
    std::partial_sum(result.begin.begin(), result.begin.end(), result.begin.begin());
    result.item.resize(result.begin.back());
    std::vector<int> next(result.begin.begin(), result.begin.end() - 1);
    for (int f = 0; f < mesh.face_count(); ++f)
        for (int c = 0; c < 3; ++c) result.item[next[mesh.faces(f, c)]++] = f;
    return result;
}

std::vector<int> vertices_of(const TriangleMesh& mesh, std::span<const int> faces) {
    std::vector<int> vertices;
    for (const int f : faces)
        for (int k = 0; k < 3; ++k) vertices.push_back(mesh.faces(f, k));
    make_set(vertices);
    return vertices;
}

UsedVertices used_vertices(const Faces& faces, int vertex_count) {
    UsedVertices used{{}, std::vector<int>(std::size_t(vertex_count), -1), faces};
    for (const int v : faces.reshaped()) used.number[std::size_t(v)] = 0;
    for (int v = 0; v < vertex_count; ++v) {
        if (used.number[std::size_t(v)] < 0) continue;
        used.number[std::size_t(v)] = int(used.vertex.size());
        used.vertex.push_back(v);
    }
    for (int& corner : used.faces.reshaped()) corner = used.number[std::size_t(corner)];
    return used;
}

int count_used_vertices(const TriangleMesh& mesh) {
    std::vector<char> used(std::size_t(mesh.vertex_count()), 0);
    for (const int v : mesh.faces.reshaped()) used[std::size_t(v)] = 1;
    return int(std::count(used.begin(), used.end(), 1));
}

bool repeats_vertex(const Faces& faces, int f) {
    const int a = faces(f, 0), b = faces(f, 1), c = faces(f, 2);
    return a == b || b == c || c == a;
}

Adjacency vertex_neighbours(const TriangleMesh& mesh) {
    const Adjacency faces = vertex_faces(mesh);
    Adjacency result;
    result.begin.reserve(mesh.vertex_count() + 1);
    result.item.reserve(faces.item.size() + faces.item.size() / 8);
    std::vector<int> around;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        around.clear();
        for (const int f : faces[v])
            for (int c = 0; c < 3; ++c)
                if (mesh.faces(f, c) != v) around.push_back(mesh.faces(f, c));
        make_set(around);
        result.item.insert(result.item.end(), around.begin(), around.end());
        result.begin.push_back(int(result.item.size()));
    }
    return result;
}

VertexData<double> longest_edges(const TriangleMesh& mesh) {
    VertexData<double> longest(mesh.vertex_count(), 0);
    for (int f = 0; f < mesh.face_count(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int a = mesh.faces(f, k), b = mesh.faces(f, (k + 1) % 3);
            const double length = (mesh.vertex(a) - mesh.vertex(b)).norm();
            for (const int v : {a, b}) longest[v] = std::max(longest[v], length);
        }
    return longest;
}

SurfacePoint point_at_vertex(const TriangleMesh& mesh, int v) {
    for (int f = 0; f < mesh.face_count(); ++f)
        for (int k = 0; k < 3; ++k)
            if (mesh.faces(f, k) == v) return {f, Vec3::Unit(k)};
    return {};
}

PointMap points_at_vertices(const TriangleMesh& mesh) {
    PointMap points(mesh.vertex_count());
    for (int f = mesh.face_count() - 1; f >= 0; --f)
        for (int k = 2; k >= 0; --k) points[mesh.faces(f, k)] = {f, Vec3::Unit(k)};
    return points;
}

int vertex_of(const TriangleMesh& mesh, const SurfacePoint& point) {
    for (int k = 0; k < 3; ++k)
        if (point.barycentric == Vec3::Unit(k)) return mesh.faces(point.face, k);
    return -1;
}

Edges find_edges(const TriangleMesh& mesh) {
    const std::vector<HalfEdgeEnds> sorted = half_edges_by_edge(mesh);
    Edges edges;
    edges.of_half_edge.resize(sorted.size());
    edges.half_edges.item.reserve(sorted.size());
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        const auto [low, high, half_edge] = sorted[i];
        if (i == 0 || low != sorted[i - 1].low || high != sorted[i - 1].high) {
            if (i > 0) edges.half_edges.begin.push_back(int(i));
            edges.vertices.push_back({low, high});
        }
        edges.half_edges.item.push_back(half_edge);
        edges.of_half_edge[std::size_t(half_edge)] = edges.size() - 1;
    }
    if (!sorted.empty()) edges.half_edges.begin.push_back(int(sorted.size()));
    return edges;
}

std::vector<int> opposite_half_edges(const Edges& edges) {
    std::vector<int> opposite(edges.of_half_edge.size(), -1);
    for (int e = 0; e < edges.size(); ++e) {
        const auto half_edges = edges.half_edges[e];
        if (half_edges.size() != 2) continue;
        opposite[std::size_t(half_edges[0])] = half_edges[1];
        opposite[std::size_t(half_edges[1])] = half_edges[0];
    }
    return opposite;
}

std::vector<std::vector<int>> face_components(const Edges& edges, std::vector<char> marked) {
    std::vector<std::vector<int>> parts;
    for (int seed = 0; seed < int(marked.size()); ++seed) {
        if (!marked[std::size_t(seed)]) continue;
        std::vector<int> part{seed};
        marked[std::size_t(seed)] = 0;
        for (std::size_t i = 0; i < part.size(); ++i)
            for (int k = 0; k < 3; ++k)
                for (const int h : edges.half_edges[edges.of_half_edge[std::size_t(3 * part[i] + k)]])
                    if (char& mark = marked[std::size_t(h / 3)]; mark) {
                        mark = 0;
                        part.push_back(h / 3);
                    }
        parts.push_back(std::move(part));
    }
    return parts;
}

VertexData<int> count_fans(const TriangleMesh& mesh, const Edges& edges, const FaceData<char>& marked) {
    DisjointSets fans(3 * mesh.face_count());  // of corners, by the half-edges that leave them
    for (int e = 0; e < edges.size(); ++e) {
        const auto half_edges = edges.half_edges[e];
        if (half_edges.size() < 2 || !marked[half_edges[0] / 3] || !marked[half_edges[1] / 3]) continue;
        fans.join(half_edges[0], next_half_edge(half_edges[1]));
        fans.join(next_half_edge(half_edges[0]), half_edges[1]);
    }
    VertexData<int> count(mesh.vertex_count(), 0);
    for (int c = 0; c < 3 * mesh.face_count(); ++c)
        if (marked[c / 3] && fans.lowest(c) == c) ++count[mesh.faces(c / 3, c % 3)];
    return count;
}

ConnectedComponents connected_components(const TriangleMesh& mesh) {
    const int n = mesh.vertex_count();
    ConnectedComponents components{0, std::vector<int>(std::size_t(n), -1), {}};
    DisjointSets sets(n);
    for (int f = 0; f < mesh.face_count(); ++f)
        for (int c = 1; c < 3; ++c) sets.join(mesh.faces(f, 0), mesh.faces(f, c));
    std::vector<char> used(std::size_t(n), 0);
    for (const int v : mesh.faces.reshaped()) used[std::size_t(v)] = 1;
    for (int v = 0; v < n; ++v) {
        if (!used[std::size_t(v)]) continue;
        const int root = sets.lowest(v);
        components.of_vertex[std::size_t(v)] =
            root == v ? components.count++ : components.of_vertex[std::size_t(root)];
    }
    components.of_face.reserve(std::size_t(mesh.face_count()));
    for (int f = 0; f < mesh.face_count(); ++f)
        components.of_face.push_back(components.of_vertex[std::size_t(mesh.faces(f, 0))]);
    return components;
}

std::vector<std::vector<int>> ConnectedComponents::faces() const {
    std::vector<std::vector<int>> faces(static_cast<std::size_t>(count));
    for (int f = 0; f < int(of_face.size()); ++f) faces[std::size_t(of_face[std::size_t(f)])].push_back(f);
    return faces;
}

std::vector<double> ConnectedComponents::areas(const TriangleMesh& mesh) const {
    std::vector<double> areas(std::size_t(count), 0);
    for (int f = 0; f < mesh.face_count(); ++f)
        areas[std::size_t(of_face[std::size_t(f)])] += face_normal(mesh, f).norm() / 2;
    return areas;
}

TopologySummary summarise_topology(const TriangleMesh& mesh) {
    const Edges edges = find_edges(mesh);
    TopologySummary summary{count_used_vertices(mesh), find_boundary(mesh, edges).loops, 0};
    const int euler = summary.used_vertices - edges.size() + mesh.face_count();
    summary.genus = (2 * connected_components(mesh).count - summary.boundary_loops - euler) / 2;
    return summary;
}

bool is_closed(const TriangleMesh& mesh) {
    const Edges edges = find_edges(mesh);
    const auto start = [&](int half_edge) { return mesh.faces(half_edge / 3, half_edge % 3); };
    for (int e = 0; e < edges.size(); ++e) {
        const auto half_edges = edges.half_edges[e];
        if (half_edges.size() != 2 || start(half_edges[0]) == start(half_edges[1])) return false;
    }
    return true;
}

double signed_volume(const TriangleMesh& mesh, const Vec3& origin) {
    double sum = 0;
    for (int f = 0; f < mesh.face_count(); ++f)
        sum += (mesh.vertex(mesh.faces(f, 0)) - origin).dot(face_normal(mesh, f)) / 6;
    return sum;
}

}  // namespace varimap
