#pragma once

#include "varimap/mesh/closest_point.h"
#include "varimap/surface/surface.h"

namespace varimap {

/// The input in the coordinates of the mesh.
TriangleMesh normalised_input(const Surface& surface);

/// Where points of a surface's mesh, and points in space near it, lie on its input: exactly where the mesh
/// was made by bisection; else the closest point of the input that faces the same way. Keeps a reference to
/// the surface. Thread-safe once built.
class InputLocator {
  public:
    explicit InputLocator(const Surface& surface)
        : surface_(surface), closest_([&surface] { return normalised_input(surface); }) {}

    SurfacePoint operator()(const SurfacePoint& on_mesh) const;
    /// x in the coordinates of the mesh, near it; `normal`: of the surface there, of any length; `guess`: a
    /// face of the input that may be near, which saves time.
    SurfacePoint operator()(const Vec3& x, const Vec3& normal, int guess = -1) const;

  private:
    const Surface& surface_;
    ClosestPointOnDemand closest_;  ///< on the input; not needed where the way there is exact
};

/// The vertex of the surface's file nearest to where a vertex of its mesh lies.
int nearest_in_file(const Surface& surface, int vertex);

/// Where points of a surface's input lie on its mesh: as its corners do, linearly between them. Keeps a
/// reference to the surface. Thread-safe.
class MeshLocator {
  public:
    explicit MeshLocator(const Surface& surface)
        : surface_(surface), closest_([&surface] { return surface.mesh; }) {}
    SurfacePoint operator()(const SurfacePoint& on_input) const;

  private:
    const Surface& surface_;
    ClosestPointOnDemand closest_;  ///< not needed where all points are vertices of the input
};

}  // namespace varimap
