#pragma once

#include "varimap/spectral/hierarchy.h"
#include "varimap/surface/surface.h"

namespace varimap {

/// What the solving stages read of one surface, or of another domain: then `surface` is its Domain, with the
/// points as `input`.
struct SurfaceData {
    Surface surface;
    Basis basis;
    Hierarchy hierarchy;
};

}  // namespace varimap
