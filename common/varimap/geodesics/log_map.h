#pragma once

#include <utility>

#include "varimap/mesh/topology.h"
#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// The Riemannian logarithm of a surface: where a point lies as seen from another, as the direction in which
/// the shortest path to it leaves, times its length. In a plane that belongs to the point one looks from:
/// that of its face; at a vertex, the star unrolled, with angles scaled to a full turn (on a boundary as they
/// are). Keeps a reference to the mesh. Thread-safe.
class LogMap {
  public:
    /// Faces that the search for a path looks at, unless told otherwise.
    static constexpr int usual_farthest = 20'000;
    explicit LogMap(const TriangleMesh& mesh) : LogMap(mesh, find_shared_edges(mesh)) {}
    LogMap(const TriangleMesh& mesh, SharedEdges edges) : mesh_(mesh), edges_(std::move(edges)) {}

    /// b as seen from a, and a as seen from b. Both must have a face. Where no path is found (other
    /// components, too far, or a detour of more than 6 times their distance), both are 0.
    std::pair<Vec2, Vec2> operator()(const SurfacePoint& a, const SurfacePoint& b,
                                     int farthest = usual_farthest) const;
    /// What is seen from a point within a face, in space.
    Vec3 in_space(int face, const Vec2& seen) const;

  private:
    Vec2 in_plane_of(int face, const Vec3& away) const;
    /// `length` of the path through the strip from the vertex.
    Vec2 seen_from_vertex(int vertex, const struct TriangleStrip& strip, const Vec3& to, double length) const;

    const TriangleMesh& mesh_;
    SharedEdges edges_;
};

}  // namespace varimap
