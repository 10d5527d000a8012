#pragma once

#include <vector>

#include "varimap/mesh/topology.h"

namespace varimap {

/// Marks the components that are inner walls, as CT, hollow prints and voxel remeshers leave them: closed but
/// for pinholes, within another such one but for a tenth of their area, and with faces that look the
/// other way than those of the outermost around them. What lies inside and looks as that does is a body of
/// its own, such as an eye or a seed. Only `candidates` (per component) are looked at, as walls and as what
/// is around them. `components`: of the mesh, which is manifold.
std::vector<char> find_cavities(const TriangleMesh& mesh, const ConnectedComponents& components,
                                const std::vector<char>& candidates);

}  // namespace varimap
