#pragma once

#include <string>

#include "varimap/mesh_repair/mesh_repair.h"
#include "varimap/results/map_file.h"
#include "varimap/verification/verification.h"

namespace varimap {

/// Reads two meshes and a map between them (map_file.h) and judges the map; `mirror`: it reverses orientation
/// on purpose, and triangles that keep it are the reversed ones. The meshes are repaired as
/// varimap-preprocess does it; what is found has the numbers of the files. Throws InputError (no surface, a
/// map that does not fit the meshes), IoError.
Verification verify_files(const std::string& source_mesh, const std::string& target_mesh,
                          const std::string& map, bool mirror = false, const RepairOptions& options = {},
                          IndexBase base = IndexBase::automatic);

/// The numbers, one per line.
std::string as_text(const Verification& found);
/// An object: reversed_count, reversed_area_percent, cutting_count, branch_points, signed_area_ratio, degree
/// (absent if it has none), left_out_count, reversed_faces and branch_vertices (0-based, of the source).
std::string as_json(const Verification& found);

}  // namespace varimap
