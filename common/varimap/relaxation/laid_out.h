#pragma once

#include <array>

#include "varimap/mesh/log_map.h"

namespace varimap {

/// How a triangle lies along a surface.
struct Lie {
    /// Which way round it goes: the sum of its signed areas as laid out from each corner, by the sum of their
    /// sizes. 1 where all are counter-clockwise from outside, -1 where clockwise, between where they differ,
    /// because it lies around a bend. NaN where two corners are not connected or as far apart along the
    /// surface as torn triangles have them, or it has no area.
    double sense;
    /// Angle at each corner from the side that leaves it to the one that comes in; negative if clockwise.
    std::array<double, 3> turns;
};

/// Triangles of surface points as they lie along the surface, whatever a straight triangle between them would
/// cut through: their sides are shortest paths. Keeps a reference to the mesh. Thread-safe.
class LaidOut {
  public:
    explicit LaidOut(const TriangleMesh& mesh) : log_map_(mesh, farthest) {}

    Lie operator()(const std::array<SurfacePoint, 3>& corners) const;

  private:
    /// Faces looked at for the path between two corners. Those of torn triangles are looked for in vain again
    /// and again.
    static constexpr int farthest = 2000;
    LogMap log_map_;
};

}  // namespace varimap
