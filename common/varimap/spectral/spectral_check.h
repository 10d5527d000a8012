#pragma once

#include "varimap/spectral/hierarchy.h"

namespace varimap {

// Check every part of what was read, whose hash may be right and whose content wrong all the same: sizes,
// finite numbers, ranges, order. Throw ArtifactError.

void require_complete(const Basis& basis);
void require_complete(const Hierarchy& hierarchy);

}  // namespace varimap
