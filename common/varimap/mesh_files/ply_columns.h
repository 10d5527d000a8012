#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "varimap/mesh/triangle_mesh.h"
#include "varimap/mesh_files/mesh_file.h"
#include "varimap/mesh_files/number_type.h"

namespace varimap {

/// A property of a PLY file that is one number: its name, its type as PLY calls it, a value for each element.
struct PlyColumn {
    std::string name, type;
    std::vector<double> values;
};

/// The numbers of the vertices, positions among them, and of the faces. Lists are left out.
struct PlyColumns {
    std::vector<PlyColumn> vertex, face;
    std::vector<std::size_t> corners;  ///< how many each face has; empty where the file does not list them
};
/// Throws InputError naming the place in the file. `path` is for messages only.
PlyColumns parse_ply_columns(std::string_view bytes, const std::string& path);

/// The number type that PLY calls so; none where it knows no such type.
const NumberType* ply_type(std::string_view name);

/// Whether a PLY file is text.
PlyFormat ply_format(std::string_view bytes);

/// The mesh as to_ply (mesh_file.h) writes it, with further properties.
std::string to_ply(const TriangleMesh& mesh, const PlyColumns& columns, PlyFormat format);

}  // namespace varimap
