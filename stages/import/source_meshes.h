#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "varimap/mesh_files/polygon_soup.h"

namespace varimap {

// The meshes of a file as their points and polygons stand there, in the coordinates of their own, before any
// is placed. Assimp gives every corner a vertex of its own; this tells which corners share one. What cannot
// be understood is left out: then corners are joined by their places. Nothing is thrown.

/// FBX, binary or ascii: each Geometry's Vertices and PolygonVertexIndex.
std::vector<PolygonSoup> fbx_meshes(std::string_view bytes);
/// COLLADA: each mesh's POSITION source, and its triangles, polylists and polygons in their order.
std::vector<PolygonSoup> collada_meshes(std::string_view text);

}  // namespace varimap
