#include "varimap/mesh/topology.h"

#include <algorithm>
#include <numeric>

#include "varimap/core/index_set.h"
#include "varimap/mesh/boundary.h"
#include "varimap/mesh/disjoint_sets.h"

namespace varimap {
namespace {

struct Side {
    int low, high;  ///< the edge's vertices
    int side;
};

/// By edge, those of one edge ascending. Sides are dealt to their lower vertices, where a few are to be
/// sorted: a tenth of the time that sorting all at once takes.
std::vector<Side> sorted_sides(const TriangleMesh& mesh) {
    const int count = 3 * mesh.face_count();
    const auto side_at = [&](int s) {
        const int a = mesh.faces(s / 3, s % 3), b = mesh.faces(s / 3, (s + 1) % 3);
        return Side{std::min(a, b), std::max(a, b), s};
    };
    int vertices = 0;
    for (int s = 0; s < count; ++s) vertices = std::max(vertices, side_at(s).low + 1);
    std::vector<int> begin(std::size_t(vertices) + 1, 0);
    for (int s = 0; s < count; ++s) ++begin[std::size_t(side_at(s).low) + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<Side> sides(static_cast<std::size_t>(count));
    std::vector<int> next = begin;
    for (int s = 0; s < count; ++s) sides[std::size_t(next[std::size_t(side_at(s).low)]++)] = side_at(s);
    for (std::size_t v = 0; v < std::size_t(vertices); ++v)
        std::sort(sides.begin() + begin[v], sides.begin() + begin[v + 1], [](const Side& x, const Side& y) {
            return x.high != y.high ? x.high < y.high : x.side < y.side;
        });
    return sides;
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
    const std::vector<Side> sides = sorted_sides(mesh);
    Edges edges;
    edges.of_side.resize(sides.size());
    edges.sides.item.reserve(sides.size());
    for (std::size_t i = 0; i < sides.size(); ++i) {
        if (i == 0 || sides[i].low != sides[i - 1].low || sides[i].high != sides[i - 1].high) {
            if (i > 0) edges.sides.begin.push_back(int(i));
            edges.vertices.push_back({sides[i].low, sides[i].high});
        }
        edges.sides.item.push_back(sides[i].side);
        edges.of_side[sides[i].side] = edges.size() - 1;
    }
    if (!sides.empty()) edges.sides.begin.push_back(int(sides.size()));
    return edges;
}

std::vector<std::vector<int>> face_components(const Edges& edges, std::vector<char> marked) {
    std::vector<std::vector<int>> parts;
    for (int seed = 0; seed < int(marked.size()); ++seed) {
        if (!marked[std::size_t(seed)]) continue;
        std::vector<int> part{seed};
        marked[std::size_t(seed)] = 0;
        for (std::size_t i = 0; i < part.size(); ++i)
            for (int k = 0; k < 3; ++k)
                for (const int side : edges.sides[edges.of_side[std::size_t(3 * part[i] + k)]])
                    if (char& mark = marked[std::size_t(side / 3)]; mark) {
                        mark = 0;
                        part.push_back(side / 3);
                    }
        parts.push_back(std::move(part));
    }
    return parts;
}

VertexData<int> count_fans(const TriangleMesh& mesh, const Edges& edges, const FaceData<char>& marked) {
    const auto next = [](int corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; };
    DisjointSets fans(3 * mesh.face_count());  // of corners
    for (int e = 0; e < edges.size(); ++e) {
        const auto sides = edges.sides[e];
        if (sides.size() < 2 || !marked[sides[0] / 3] || !marked[sides[1] / 3]) continue;
        fans.join(sides[0], next(sides[1]));
        fans.join(next(sides[0]), sides[1]);
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
    const auto start = [&](int side) { return mesh.faces(side / 3, side % 3); };
    for (int e = 0; e < edges.size(); ++e) {
        const auto sides = edges.sides[e];
        if (sides.size() != 2 || start(sides[0]) == start(sides[1])) return false;
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
