#pragma once

#include <memory>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// Geodesic distances between points of a triangle mesh, in the mesh's units.
///
/// A* on a graph of points spread over the edges (no vertices), those on the edges of one face joined by
/// straight segments; the Euclidean distance is its admissible bound, so near pairs are cheap. The path found
/// is then straightened (triangle_strip.h) until it is locally shortest. The answer is the length of a path
/// on the mesh, so never below the geodesic distance; it exceeds it only where a path of another, almost as
/// short kind won in the graph, well under 1% on meshes with triangles up to ten times as long as wide.
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
