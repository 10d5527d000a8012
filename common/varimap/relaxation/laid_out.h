#pragma once

#include <array>

#include "varimap/mesh/log_map.h"

namespace varimap {

/// Triangles of surface points as they lie along the surface, whatever a straight triangle between them would
/// cut through: their sides are shortest paths. Keeps a reference to the mesh. Thread-safe.
class LaidOut {
  public:
    explicit LaidOut(const TriangleMesh& mesh) : log_map_(mesh) {}

    /// Which way round the triangle goes: the sum of its signed areas as laid out from each corner, by the
    /// sum of their sizes. 1 where all are counter-clockwise from outside, -1 where clockwise, between where
    /// they differ, because it lies around a bend. NaN where two corners are not connected, or it has no
    /// area.
    double sense(const std::array<SurfacePoint, 3>& corners) const;

  private:
    LogMap log_map_;
};

}  // namespace varimap
