#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "varimap/mesh_files/polygon_soup.h"

namespace varimap {

/// Per triangle, in the order of the polygons, where its corners stand in soup.corners. A polygon of n
/// corners becomes n - 2 triangles: fanned from its first corner, unless that folds (a triangle looks against
/// the polygon, which is concave); then ears are cut off in its plane, that of its vector area. What has no
/// ears, since it crosses itself, or more than 4000 corners, is fanned all the same. Corners must be
/// vertices.
std::vector<std::array<std::size_t, 3>> triangle_corners(const PolygonSoup& soup);

}  // namespace varimap
