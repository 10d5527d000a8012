#pragma once

#include "varimap/mesh_repair/mesh_repair.h"

namespace varimap {

/// Joins the components of a repaired mesh, the largest first and each where it comes nearest to those
/// before, so that the method finds one surface: a face of each makes room for a tube of six between their
/// corners. These are added faces of the link; vertices stay as they are. Topology is that of a connected
/// sum: the genus is the sum of the components' own. A connected mesh comes back as it is. Returns the mesh,
/// with the number of tubes in counts.bridges.
RepairedMesh bridged(RepairedMesh mesh);

}  // namespace varimap
