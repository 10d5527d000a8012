#pragma once

#include "varimap/spectral/hierarchy.h"
#include "varimap/spectral/surface_data.h"

namespace varimap {

// Check every part of what was read, whose hash may be right and whose content wrong all the same: sizes,
// finite numbers, ranges, order. Throw ArtifactError.

void require_complete(const Basis& basis);
void require_complete(const Hierarchy& hierarchy);

// Check that what was read belongs to one surface. Throw ArtifactError.

void require_fit(const Basis& basis, const Domain& domain);
void require_fit(const SurfaceData& data);

}  // namespace varimap
