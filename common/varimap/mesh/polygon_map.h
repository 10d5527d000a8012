#pragma once

#include <vector>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// A vertex and where it is to be in the plane.
struct Pin {
    int vertex;
    Vec3 position;  ///< z = 0
};

/// Where the vertices of a disc go under a homeomorphism onto a simple polygon in the plane z = 0. `chart`:
/// the disc in the circle (circular_chart), into which a triangulation of the polygon is embedded, too, with
/// the same corners: corner i of `polygon` (one per row, counter-clockwise) is the place of boundary[i], in
/// the order of disc_boundary. In between, the circle is mapped onto itself, so that pins, which lie inside
/// both, go where they are to be: one after the other, each by a fan whose centre moves. One position per
/// row; none if the polygon is not simple, or a pin lies outside or in the way of another. A face between the
/// positions may be reversed where the homeomorphism bends sharply.
Points map_onto_polygon(const TriangleMesh& chart, const std::vector<int>& boundary, const Points& polygon,
                        const std::vector<Pin>& pins);

/// Ears cut off a simple polygon in the plane z = 0, the best shaped first; n - 2 triangles, none if the
/// polygon is not simple and counter-clockwise. O(n^3).
Faces cut_into_ears(const Points& polygon);

}  // namespace varimap
