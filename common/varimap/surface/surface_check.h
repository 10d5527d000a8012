#pragma once

#include "varimap/surface/surface.h"

namespace varimap {

/// Checks every part of a surface that was read, whose hash may be right and whose content wrong all the
/// same: sizes, indices, finite coordinates, manifold meshes, the way back, area and masses. Throws
/// ArtifactError.
void require_complete(const Surface& surface);

}  // namespace varimap
