#pragma once

#include <array>
#include <vector>

#include "varimap/mesh/topology.h"

namespace varimap {

/// The edges of a mesh that have one face, by the loops that they form. Loops that touch count as one.
struct Boundary {
    std::vector<std::array<int, 2>> edges;  ///< their vertices; ascending
    std::vector<int> loop;                  ///< per edge: its loop, numbered by lowest vertex from 0
    int loops = 0;
};
/// Edges may have any number of faces. `edges`: of the mesh, where they are there already.
Boundary find_boundary(const TriangleMesh& mesh, const Edges& edges);
Boundary find_boundary(const TriangleMesh& mesh);
/// Marks the vertices that lie on it.
VertexData<bool> boundary_vertices(const TriangleMesh& mesh, const Edges& edges);

/// A boundary loop: its vertices, in the order in which faces that close it name them.
using BoundaryLoop = std::vector<int>;

/// All of them, each from its lowest vertex, by these. Of a manifold mesh: where loops touch, some end early.
std::vector<BoundaryLoop> boundary_loops(const TriangleMesh& mesh, const Edges& edges);

/// Per loop its length, in units of the mesh.
std::vector<double> loop_lengths(const TriangleMesh& mesh, const Boundary& boundary);

/// That of all loops, in units of sqrt(area).
double boundary_length(const TriangleMesh& mesh);

/// Per loop how wide it is open: the length of the sum of what leads out of the surface across its edges,
/// each as long as the edge, in its face, at right angles to it. At the end of a tube these point the same
/// way, and the sum is as long as the way around it, however jagged the cut; around a hole in a wall they
/// point to all sides and cancel.
std::vector<double> loop_openings(const TriangleMesh& mesh, const Edges& edges, const Boundary& boundary);

/// The volume (signed_volume, topology.h) that a mesh encloses once each of its boundary loops is closed by
/// triangles to the middle of its vertices.
double signed_volume_when_closed(const TriangleMesh& mesh);

/// Whether it is mostly rim, as a leaf, a shirt or the scan of a face are: its boundary is at least 3
/// sqrt(area) long (a disc's 3.5, a hemisphere's 2.5). Chosen by hand. Such a surface bends easily, and its
/// rim tells where its points are.
bool is_sheet(const TriangleMesh& mesh);

/// Which way the faces of a surface look: 1 outward, -1 inward; 0 where it has no inside, because it is a
/// sheet, or open and encloses next to nothing (signed_volume_when_closed).
int orientation_sign(const TriangleMesh& mesh);

}  // namespace varimap
