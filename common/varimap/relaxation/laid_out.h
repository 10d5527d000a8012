#pragma once

#include <array>
#include <utility>

#include "varimap/mesh/topology.h"
#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// Triangles of surface points as they lie along the surface, whatever a straight triangle between them would
/// cut through: their sides are shortest paths. Keeps a reference to the mesh. Thread-safe.
class LaidOut {
  public:
    explicit LaidOut(const TriangleMesh& mesh) : mesh_(mesh), edges_(find_edges(mesh)) {}

    /// Which way round the triangle goes: the sum of its signed areas as laid out from each corner, by the
    /// sum of their sizes. 1 where all are counter-clockwise from outside, -1 where clockwise, between where
    /// they differ, because it lies around a bend. NaN where two corners are not connected, or it has no
    /// area.
    double sense(const std::array<SurfacePoint, 3>& corners) const;

    const Edges& edges() const { return edges_; }

  private:
    /// Where the shortest paths between two points leave for the other, times their length.
    std::pair<Vec3, Vec3> headings(const SurfacePoint& a, const SurfacePoint& b) const;

    const TriangleMesh& mesh_;
    Edges edges_;
};

}  // namespace varimap
