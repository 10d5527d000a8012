#pragma once

#include <vector>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// How the faces of a mesh hang together as oriented manifold sheets.
struct Sheets {
    Faces faces;               ///< of the sheets' vertices; the corners are those of the mesh, not turned
    std::vector<int> origin;   ///< per vertex of the sheets: the mesh's; ascending
    std::vector<char> turned;  ///< per face: to be reversed
    int cut_edges = 0;         ///< of three or more faces
    int opened_edges = 0;      ///< where a surface with one side only was cut open
};

/// Cuts a mesh into sheets and orients them alike, as repaired() in mesh_repair.h says. Where the mesh is
/// manifold and oriented, nothing is cut or turned. Faces must not name a vertex twice. O(n log n).
///
/// Faces are partners over an edge; corners of partners at the same vertex are one; what is one is a vertex
/// (cutting and stitching, Guéziec et al. 2001).
Sheets find_sheets(const TriangleMesh& mesh);

}  // namespace varimap
