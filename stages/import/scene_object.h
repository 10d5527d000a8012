#pragma once

#include <cstddef>
#include <vector>

#include "varimap/mesh_files/polygon_soup.h"

namespace varimap {

/// The polygons of an object, which assimp parts by materials.
struct SceneObject {
    PolygonSoup soup;
    std::vector<Eigen::Vector2d> uv;  ///< per corner, or none
    std::vector<unsigned> material;   ///< per polygon: assimp's
};

/// Where the corners of a polygon begin.
std::size_t polygon_begin(const PolygonSoup& soup, std::size_t polygon);

/// Where assimp has given every corner a vertex of its own: the points and polygons of that of the file's
/// meshes (source_meshes.h) which the object is; if it is none of these, corners in the same place become one
/// vertex.
void share_vertices(const std::vector<PolygonSoup>& meshes, SceneObject& object);

}  // namespace varimap
