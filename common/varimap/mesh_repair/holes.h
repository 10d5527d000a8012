#pragma once

#include <string>
#include <vector>

#include "varimap/mesh/boundary.h"
#include "varimap/mesh_repair/mesh_repair.h"

namespace varimap {

/// The longest boundary loops, in edges, that `words` asks to be closed: a number of at least 3, "none" (0)
/// or "all". Throws UsageError for others.
int longest_hole(const std::string& words);

/// Closes the boundary loops of at most `edges` edges of a repaired mesh: with the triangulation of least
/// area (Barequet and Sharir 1995) that has no edge the mesh has already and, where that can be, no thin
/// faces. Of loops of more than 200 edges the best ears are cut off first. Vertices stay as they are; the
/// faces are added ones of the link, so that no row of the file changes its meaning. A loop that cannot be
/// closed so stays open. Returns the mesh, with the numbers in `counts`. O(200^2 n + n log n) for loops of n
/// edges.
RepairedMesh holes_filled(RepairedMesh mesh, int edges);

/// Closes in the same way the loops that are slits: those which faces of hardly any area close. Such are left
/// by a vertex that lies on an edge of other faces (a T-junction), and where the two sides of a seam have
/// other vertices. Loops of at most 200 edges.
RepairedMesh slits_closed(RepairedMesh mesh);

/// Closes some boundary loops, as above. Returns which could be closed.
std::vector<char> close_loops(RepairedMesh& mesh, const std::vector<BoundaryLoop>& loops);

}  // namespace varimap
