#pragma once

#include <string>
#include <vector>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// What a mesh file holds, as it stands there: points and polygons in file order, nothing merged or dropped.
struct PolygonSoup {
    std::vector<Vec3> points;
    std::vector<long long> corners;  ///< of all polygons, one after the other; 0-based, not yet checked
    std::vector<std::size_t> ends;   ///< per polygon: one past its last entry in corners

    void end_polygon() { ends.push_back(corners.size()); }
};

// Readers of one format each, from the bytes of a file; `path` is for messages only. Numbers are read in
// double precision and in the C locale's form. Throw InputError naming the place in the file.

/// Wavefront OBJ: `v` (further numbers, as colours, are ignored) and `f` (a, a/b, a//c, a/b/c, negative
/// indices).
PolygonSoup parse_obj(const std::string& bytes, const std::string& path);
/// Ascii OFF, one vertex or face per line; normals and colours (NOFF, COFF, ...) are ignored.
PolygonSoup parse_off(const std::string& bytes, const std::string& path);
/// PLY 1.0, ascii or binary of either byte order; other elements and properties are skipped.
PolygonSoup parse_ply(const std::string& bytes, const std::string& path);
/// STL, ascii or binary; corners with equal coordinates become one vertex, numbered by first appearance.
PolygonSoup parse_stl(const std::string& bytes, const std::string& path);

}  // namespace varimap
