#pragma once

#include <limits>
#include <vector>

#include "varimap/mesh/topology.h"
#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// Triangles in a row: edges[i] lies between faces[i] and faces[i + 1].
struct TriangleStrip {
    std::vector<int> faces, edges;
};

/// The face beyond an edge of a face; -1 on a boundary, and where the edge has more than two.
inline int face_beyond(const Edges& edges, int edge, int face) {
    const auto half_edges = edges.half_edges[edge];
    if (half_edges.size() != 2) return -1;
    return half_edges[0] / 3 == face ? half_edges[1] / 3 : half_edges[0] / 3;
}

/// The angle of a face at one of its vertices.
double corner_angle(const TriangleMesh& mesh, int face, int vertex);

/// A path along a surface, by its ends: where each lies as seen from the other, as the direction in which the
/// path leaves, in the plane of the end's face, times the path's length.
struct StraightPath {
    double length = 0;
    Vec3 goal_from_start, start_from_goal;
};

/// The shortest path from `start` to `goal` on the surface, near the strip. The strip is unfolded
/// into the plane, where the funnel algorithm finds its shortest path; the strip is led past the other side
/// of a vertex if this shortens the path, until nothing does: where it bends, since otherwise it is not even
/// locally shortest, and, where it is longer than straight by 3%, at all vertices along the strip,
/// since of two locally shortest paths, one on either side of a spike, the search for a strip may have found
/// the longer. `strip` becomes the strip that holds the path. `start` lies in its first face, `goal` in its
/// last.
StraightPath straighten(const TriangleMesh& mesh, const Edges& edges, TriangleStrip& strip, const Vec3& start,
                        const Vec3& goal);

/// The shortest path within the strip.
StraightPath straight_path(const TriangleMesh& mesh, const Edges& edges, const TriangleStrip& strip,
                           const Vec3& start, const Vec3& goal);

/// The strip that a plane through two points cuts out of the surface, about upright on it, if it leads
/// straight from one to the other in a few faces; else empty. Where it does, as between most points of a
/// smooth map that are near each other, it takes a fraction of the time of `find_strip`.
TriangleStrip straight_strip(const TriangleMesh& mesh, const Edges& edges, const SurfacePoint& from,
                             const SurfacePoint& to);

/// The strip of least length by the faces' centres, from one face to another (A*). Empty if they are not
/// connected, if more than `most` faces have to be looked at, or if the way is longer than `detour` times the
/// centres' distance and the longest edge of both faces together. No geodesic yet: `straighten` makes one of
/// it.
TriangleStrip find_strip(const TriangleMesh& mesh, const Edges& edges, int from, int to, int most,
                         double detour = std::numeric_limits<double>::infinity());

}  // namespace varimap
