#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "varimap/mesh/triangle_mesh.h"
#include "varimap/mesh_files/mesh_file.h"

namespace varimap {

/// What a mesh file holds, as it stands there: points and polygons in file order, nothing merged or dropped.
struct PolygonSoup {
    std::vector<Vec3> points;
    std::vector<long long> corners;  ///< of all polygons, one after the other; 0-based, not yet checked
    std::vector<std::size_t> ends;   ///< per polygon: one past its last entry in corners
    Space space = Space::unstated;   ///< as stated_space finds it in the file's comments

    void end_polygon() { ends.push_back(corners.size()); }
};

/// The polygons of a mesh file, of which read_mesh (mesh_file.h) makes triangles; refused as there.
PolygonSoup read_polygons(const std::string& path);
/// The same from the bytes of such a file; `path` tells the format, and is named in messages.
PolygonSoup parse_polygons(std::string_view bytes, const std::string& path);
/// The corners of the triangles that read_mesh makes of them (polygon_cutting.h).
Faces triangulated(const PolygonSoup& soup);
/// PLY with polygons, its numbers as those of to_ply (mesh_file.h).
std::string to_ply(const PolygonSoup& soup, PlyFormat format);

/// What 3D Slicer writes into the comments of a mesh file: SPACE=LPS or SPACE=RAS.
Space stated_space(std::string_view comments);
/// The same of a space; "" for an unstated one.
std::string_view statement_of(Space space);

// Readers of one format each, from the bytes of a file; `path` is for messages only. Numbers are read in
// double precision and in the C locale's form. Throw InputError naming the place in the file.

/// Wavefront OBJ: `v` (further numbers, as colours, are ignored) and `f` (a, a/b, a//c, a/b/c, negative
/// indices).
PolygonSoup parse_obj(std::string_view bytes, const std::string& path);
/// Ascii OFF. A vertex or face starts a line, may go on in the next ones, and ends its last line: normals and
/// colours (NOFF, COFF, ...) behind it are ignored. Where there are fewer lines than vertices or faces,
/// several share a line, without normals and colours.
PolygonSoup parse_off(std::string_view bytes, const std::string& path);
/// PLY 1.0, ascii or binary of either byte order; faces or triangle strips (`tristrips`); other elements and
/// properties are skipped.
PolygonSoup parse_ply(std::string_view bytes, const std::string& path);
/// STL, ascii or binary; corners with equal coordinates become one vertex, numbered by first appearance.
PolygonSoup parse_stl(std::string_view bytes, const std::string& path);

}  // namespace varimap
