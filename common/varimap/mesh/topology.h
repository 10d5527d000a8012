#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "varimap/core/indexed.h"
#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// Lists of integers in one block: list i is item[begin[i]] ... item[begin[i + 1] - 1].
struct Adjacency {
    std::vector<int> begin{0};
    std::vector<int> item;

    int size() const { return int(begin.size()) - 1; }
    std::span<const int> operator[](int i) const {
        return {item.data() + begin[i], item.data() + begin[i + 1]};
    }
};

/// Per vertex: the faces that use it, ascending.
Adjacency vertex_faces(const TriangleMesh& mesh);
/// Per vertex: the vertices it shares an edge with, ascending.
Adjacency vertex_neighbours(const TriangleMesh& mesh);

/// The vertices that some faces use, ascending.
std::vector<int> vertices_of(const TriangleMesh& mesh, std::span<const int> faces);

/// The vertices that faces use, numbered anew.
struct UsedVertices {
    std::vector<int> vertex;  ///< those that are used, ascending
    std::vector<int> number;  ///< per vertex: where it stands among these; -1 where no face uses it
    Faces faces;              ///< by these numbers
};
/// `vertex_count`: of all, used or not.
UsedVertices used_vertices(const Faces& faces, int vertex_count);
/// How many there are. A part may come with the vertices of all that it was cut from.
int count_used_vertices(const TriangleMesh& mesh);

/// Whether a face names a vertex twice.
bool repeats_vertex(const Faces& faces, int f);

/// Per vertex: the length of its longest edge, which is as far as its faces go from it; 0 without a face.
VertexData<double> longest_edges(const TriangleMesh& mesh);

/// A vertex as a point of the first of its faces; face -1 if no face uses it.
SurfacePoint point_at_vertex(const TriangleMesh& mesh, int v);
/// Every vertex as such a point.
PointMap points_at_vertices(const TriangleMesh& mesh);
/// The vertex of its face that a point is exactly, or -1.
int vertex_of(const TriangleMesh& mesh, const SurfacePoint& point);

/// The edges of a mesh, ascending by (lower vertex, higher vertex).
/// Half-edge 3 f + c runs along face f from its corner c to its corner c + 1 (mod 3).
struct Edges {
    std::vector<std::array<int, 2>> vertices;  ///< lower, higher
    Adjacency half_edges;                      ///< per edge, ascending; one on a boundary
    std::vector<int> of_half_edge;             ///< 3 |F|: the edge of each half-edge

    int size() const { return int(vertices.size()); }
};
/// Faces must not repeat a vertex. Non-manifold edges are allowed: they have more than two half-edges.
Edges find_edges(const TriangleMesh& mesh);
/// The half-edge of the same face that begins where this one ends.
inline int next_half_edge(int half_edge) {
    return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1;
}
/// Per half-edge: the other one of its edge, or -1 where there is not exactly one other.
std::vector<int> opposite_half_edges(const Edges& edges);
/// Found once for all who need them: of a large mesh they take as much memory as the mesh.
using SharedEdges = std::shared_ptr<const Edges>;
inline SharedEdges find_shared_edges(const TriangleMesh& mesh) {
    return std::make_shared<const Edges>(find_edges(mesh));
}

/// Sets of marked faces that hang together over edges, by their lowest faces; each from that face outwards.
std::vector<std::vector<int>> face_components(const Edges& edges, std::vector<char> marked);

/// Per vertex: how many fans its marked faces form, groups that hang together over the edges at it. Edges
/// have one or two half-edges, and those run in opposite directions.
VertexData<int> count_fans(const TriangleMesh& mesh, const Edges& edges, const FaceData<char>& marked);

/// The connected components of a mesh, numbered from 0 by their lowest vertices.
struct ConnectedComponents {
    int count = 0;
    std::vector<int> of_vertex;  ///< -1 where no face uses it
    std::vector<int> of_face;

    /// Per component, ascending.
    std::vector<std::vector<int>> faces() const;
    /// Per component: its area. Of the mesh whose components they are.
    std::vector<double> areas(const TriangleMesh& mesh) const;
};
ConnectedComponents connected_components(const TriangleMesh& mesh);

/// Numbers of a manifold surface. genus = components - (boundary_loops + V - E + F) / 2: that of all of them.
struct TopologySummary {
    int used_vertices = 0;
    int boundary_loops = 0;
    int genus = 0;
};
TopologySummary summarise_topology(const TriangleMesh& mesh);

/// Whether every edge has one face on either side, of the same orientation.
bool is_closed(const TriangleMesh& mesh);

/// The volume that a closed mesh encloses, negative if its faces look inward. `origin`: best near it.
double signed_volume(const TriangleMesh& mesh, const Vec3& origin = Vec3::Zero());

}  // namespace varimap
