#include "varimap/mesh/boundary.h"

#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "varimap/mesh/disjoint_sets.h"

namespace varimap {

Boundary find_boundary(const TriangleMesh& mesh, const Edges& edges) {
    Boundary boundary;
    DisjointSets sets(mesh.vertex_count());
    for (int e = 0; e < edges.size(); ++e) {
        if (edges.half_edges[e].size() > 1) continue;
        boundary.edges.push_back(edges.vertices[e]);
        sets.join(edges.vertices[e][0], edges.vertices[e][1]);
    }
    VertexData<int> number(mesh.vertex_count(), -1);  // of the loop, at its lowest vertex
    for (const auto& [a, b] : boundary.edges) {
        int& loop = number[sets.lowest(a)];
        if (loop < 0) loop = boundary.loops++;
        boundary.loop.push_back(loop);
    }
    return boundary;
}

Boundary find_boundary(const TriangleMesh& mesh) {
    return find_boundary(mesh, find_edges(mesh));
}

VertexData<bool> boundary_vertices(const TriangleMesh& mesh, const Edges& edges) {
    VertexData<bool> marks(mesh.vertex_count(), false);
    for (int e = 0; e < edges.size(); ++e)
        if (edges.half_edges[e].size() == 1)
            for (const int v : edges.vertices[e]) marks[v] = true;
    return marks;
}

std::vector<BoundaryLoop> boundary_loops(const TriangleMesh& mesh, const Edges& edges) {
    std::vector<int> next(std::size_t(mesh.vertex_count()), -1);
    for (int e = 0; e < edges.size(); ++e) {
        if (edges.half_edges[e].size() != 1) continue;
        const int half_edge = edges.half_edges[e][0], f = half_edge / 3, c = half_edge % 3;
        next[std::size_t(mesh.faces(f, (c + 1) % 3))] = mesh.faces(f, c);
    }
    std::vector<BoundaryLoop> loops;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        if (next[std::size_t(v)] < 0) continue;
        BoundaryLoop& loop = loops.emplace_back();
        for (int at = v; at >= 0;) {
            loop.push_back(at);
            at = std::exchange(next[std::size_t(at)], -1);
        }
        loop.pop_back();  // the first one again
    }
    return loops;
}

std::vector<double> loop_lengths(const TriangleMesh& mesh, const Boundary& boundary) {
    std::vector<double> lengths(std::size_t(boundary.loops), 0);
    for (std::size_t i = 0; i < boundary.edges.size(); ++i) {
        const auto [a, b] = boundary.edges[i];
        lengths[std::size_t(boundary.loop[i])] += (mesh.vertex(a) - mesh.vertex(b)).norm();
    }
    return lengths;
}

std::vector<double> loop_openings(const TriangleMesh& mesh, const Edges& edges, const Boundary& boundary) {
    std::vector<Vec3> sums(std::size_t(boundary.loops), Vec3::Zero());
    std::size_t i = 0;  // of the boundary's edges
    for (int e = 0; e < edges.size(); ++e) {
        if (edges.half_edges[e].size() > 1) continue;
        const int f = edges.half_edges[e][0] / 3, k = edges.half_edges[e][0] % 3;
        const Vec3 along = mesh.vertex(mesh.faces(f, (k + 1) % 3)) - mesh.vertex(mesh.faces(f, k));
        sums[std::size_t(boundary.loop[i++])] += along.cross(face_normal(mesh, f).stableNormalized());
    }
    std::vector<double> openings;
    for (const Vec3& sum : sums) openings.push_back(sum.norm());
    return openings;
}

double signed_volume_when_closed(const TriangleMesh& mesh) {
    double volume = signed_volume(mesh);
    for (const BoundaryLoop& loop : boundary_loops(mesh, find_edges(mesh))) {
        Vec3 middle = Vec3::Zero();
        for (const int v : loop) middle += mesh.vertex(v) / double(loop.size());
        for (std::size_t i = 0; i < loop.size(); ++i)
            volume += middle.dot(mesh.vertex(loop[i]).cross(mesh.vertex(loop[(i + 1) % loop.size()]))) / 6;
    }
    return volume;
}

double boundary_length(const TriangleMesh& mesh) {
    const std::vector<double> lengths = loop_lengths(mesh, find_boundary(mesh));
    return std::accumulate(lengths.begin(), lengths.end(), 0.0) / std::sqrt(surface_area(mesh));
}

bool is_sheet(const TriangleMesh& mesh) {
    return boundary_length(mesh) >= 3;
}

int orientation_sign(const TriangleMesh& mesh) {
    if (is_closed(mesh)) return signed_volume(mesh) < 0 ? -1 : 1;
    // Of a ball's of the same area: people have .3, chairs .05.
    constexpr double least = 0.03;
    const double ball = std::pow(surface_area(mesh), 1.5) / (6 * std::sqrt(std::numbers::pi));
    const double volume = signed_volume_when_closed(mesh) / ball;
    if (is_sheet(mesh) || std::abs(volume) < least) return 0;
    return volume < 0 ? -1 : 1;
}

}  // namespace varimap
