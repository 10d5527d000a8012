#pragma once

#include <memory>

#include "common/mesh/triangle_mesh.h"

namespace varimap {

/// Geodesic distances between points of a triangle mesh, in the mesh's units.
///
/// A* on a graph of points spread over the edges (no vertices), those on the edges of one face joined by
/// straight segments; the Euclidean distance is its admissible bound, so near pairs are cheap. The path found
/// crosses a strip of triangles; unfolded into the plane, its shortest path is found exactly (funnel
/// algorithm) and may touch the strip's vertices. The answer is the length of a path on the mesh, so never
/// below the geodesic distance; it is exact where the graph finds the right strip, and about 1% too long at
/// worst.
///
/// Symmetric: d(a, b) == d(b, a) to the last bit. Thread-safe once built. Memory: about 60 bytes per edge
/// point.
class Geodesic {
  public:
    /// An edge of mean length carries `points_per_edge` points, a longer or shorter one in proportion,
    /// between one and eight times as many.
    explicit Geodesic(const TriangleMesh& mesh, int points_per_edge = 2);
    ~Geodesic();
    Geodesic(Geodesic&&) noexcept;

    /// Infinity between different components. Both faces must exist.
    double operator()(const SurfacePoint& a, const SurfacePoint& b) const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace varimap
