#pragma once

#include "varimap/spectral/hierarchy.h"

namespace varimap {

/// What the solving stages read of one surface.
struct SurfaceData {
    Surface surface;
    Basis basis;
    Hierarchy hierarchy;
};

}  // namespace varimap
