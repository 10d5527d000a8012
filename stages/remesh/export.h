#pragma once

#include <array>
#include <string>

#include "varimap/mesh_files/mesh_file.h"
#include "varimap/mesh_files/polygon_soup.h"
#include "varimap/results/plan.h"
#include "varimap/results/surface_map.h"
#include "varimap/stage/stage_main.h"
#include "varimap/surface/surface.h"

namespace varimap {

/// The polygons of the file that a surface was made from. Throws ArtifactError where it holds another mesh,
/// naming both files.
PolygonSoup read_polygons_of(const Surface& surface, const std::string& surface_file,
                             const std::string& file);

/// Writes a map and what it makes of the surfaces into `folder`, which is made if need be: source_to_target
/// and target_to_source (.csv, .npz), source_masses.csv, target_masses.csv, source_vertices.csv,
/// target_vertices.csv, source_on_target.ply and target_on_source.ply. Removes quality.json and picture.png
/// of another map before. `polygons`: of the files of A and of B, as their remeshed surfaces keep them; none
/// where these are not known. Throws IoError.
void export_map(Stage& stage, const std::string& folder, const SurfaceMap& map, const SamplePlan& plan,
                const Surface& A, const Surface& B, const std::array<PolygonSoup, 2>& polygons,
                PlyFormat format);

}  // namespace varimap
