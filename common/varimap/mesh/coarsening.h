#pragma once

#include <vector>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// A mesh with fewer vertices, and the bijection onto it.
struct Coarsening {
    TriangleMesh mesh;        ///< its vertices are some of those before, in their order
    std::vector<int> vertex;  ///< per vertex: the one it was before
    PointMap on_mesh;  ///< per vertex BEFORE: where it lies on `mesh`; at a vertex that is left, exactly
    PointMap points;   ///< the points that were given, on `mesh`
};

/// Where a surface has walls so thin that a coarse mesh cannot hold them apart, they shrink, and it loses
/// area.
struct ThinParts {
    int vertices = 0;      ///< with so many or fewer left, coarsening ends where
    double most_lost = 1;  ///< more than this share of the area is lost
};

/// Collapses half-edges, each removing a vertex, until `vertices` are left or no more can go: next the one
/// that costs least by the quadric error (Garland and Heckbert 1997), plus a share of its squared way and
/// area, which keeps vertices even.
///
/// Successive self-parameterisation (Lee et al. 1998; Liu et al. 2021): the faces around a vertex that goes
/// are laid into the plane (lengths from it as they are, angles scaled to a full turn, on a boundary to half
/// of one), and a collapse is allowed only where the faces that take their place are positive there. Points
/// thus pass from the old faces to the new ones one to one, and so from the first mesh to the last.
///
/// The mesh must be manifold and its vertices used; topology and boundary loops stay. Deterministic; costs
/// count as equal within a millionth, so that rounding hardly matters. O(n log n).
/// `points`: others of the mesh, inside its faces, whose places are wanted too.
Coarsening coarsen(const TriangleMesh& mesh, int vertices, const PointMap& points = {},
                   const ThinParts& thin = {});

}  // namespace varimap
