#pragma once

#include "stages/coarsen/params.h"
#include "varimap/surface/surface.h"

namespace varimap {

/// The surface at the resolution at which the map is solved for: its mesh with no more than that many
/// vertices, of unit area, and its input as it is, each of whose vertices has a place on the mesh, one to one
/// (coarsening.h). A surface with fewer vertices comes back as it is; one that was coarsened before may be
/// coarsened further.
Surface coarsened(Surface surface, const CoarsenParams& params);

}  // namespace varimap
