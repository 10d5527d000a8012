#pragma once

#include <string>

#include "varimap/mesh_repair/mesh_repair.h"

namespace varimap {

/// More handles than a surface has by design: noise, as in scans of bones.
constexpr int most_handles = 20;

/// The length of handles_cut that `words` asks for: a number up to 1, "none" (0), or "auto": .05 for a mesh
/// of more than most_handles handles; otherwise none. Throws UsageError for others.
double longest_handle(const std::string& words, const TriangleMesh& mesh);

/// Cuts small handles and closes small tunnels of a repaired mesh: along closed paths of edges that are at
/// most `length` long, in units of sqrt(area), and that do not separate the surface, the shortest first. Each
/// cut lowers the genus by one; both its rims are closed as holes are (holes.h). A tunnel is thus plugged,
/// and a strut cut through, whichever is shorter. What is longer, and boundary loops, stay.
///
/// The paths are those of shortest path trees around vertices all over the surface which close no disc
/// (Erickson and Whittlesey 2005, within a radius: Guskov and Wood 2001). A vertex on a cut is split, as by
/// repaired(): there are two in its place, one on each rim; faces that close rims are added ones of the link.
/// Deterministic; lengths count as equal within a millionth. O(n k log k) for n vertices and k within
/// `length` / 2 of one. Returns the mesh, with the number of cuts in counts.cut_handles.
RepairedMesh handles_cut(RepairedMesh mesh, double length);

}  // namespace varimap
