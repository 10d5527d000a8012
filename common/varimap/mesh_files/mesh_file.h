#pragma once

#include <string>
#include <string_view>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// Reads OBJ, PLY (ascii, binary), OFF and STL (corners welded) by the file's ending, in any case of letters.
/// Vertex order is the file's; polygons are fanned from their first corner, in file order, those that would
/// fold cut otherwise (polygon_cutting.h). Coordinates may be anything that the file says, not-a-number too.
/// Throws IoError (cannot open), InputError (unreadable, no faces, index out of range). Not OpenMesh's
/// readers: OpenMesh 9 rounds coordinates in OBJ, OFF and ascii PLY to single precision, and reports success
/// on broken files, with faces left out (index out of range) or made up (file cut short).
TriangleMesh read_mesh(const std::string& path);
/// The same from the bytes of such a file; `path` tells the format, and is named in messages.
TriangleMesh parse_mesh(std::string_view bytes, const std::string& path);
/// The vertices of such a file, which may hold no faces: a point cloud.
Points read_vertices(const std::string& path);

/// How the numbers of a PLY file are written.
enum class PlyFormat : int { binary, ascii };
/// PLY with double coordinates: binary little-endian, or text whose numbers read back exactly.
std::string to_ply(const TriangleMesh& mesh, PlyFormat format = PlyFormat::binary);

}  // namespace varimap
