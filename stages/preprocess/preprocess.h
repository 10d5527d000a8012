#pragma once

#include <string>

#include "stages/preprocess/params.h"
#include "varimap/surface/surface.h"

namespace varimap {

/// The mesh of a file made fit for preprocessing, by the parameters: repaired, holes filled, handles cut, and
/// components joined. Errors as of repaired (mesh_repair.h); UsageError for unknown words.
RepairedMesh prepared(const TriangleMesh& file, const PreprocessParams& params, const std::string& path);

/// Unit area, area centroid at the origin, edges no longer than the target (Sec. 5, Limitations), and Voronoi
/// masses. `input` must have passed require_manifold. Vertices that no face uses are left out of the result's
/// mesh. Mirroring reverses the orientation of the result's meshes. A moved, turned or uniformly scaled input
/// gives the same connectivity. Faces without area, or all but, are removed from the result's mesh
/// (thin_faces.h) with a note. Bisection to the automatic target ends at four times the vertices of the
/// input, or 10,000, with a warning: only slivers need more. Throws InputError if it would exceed
/// max_vertices, if it ends with edges beyond .25 sqrt(area), and for thin faces that cannot be removed.
Surface preprocess(const TriangleMesh& input, const PreprocessParams& params);
/// The same of a mesh that was repaired and whose components were joined, with the way back to its file.
/// Says what was repaired, as a warning unless it keeps the form.
Surface preprocess(RepairedMesh input, const PreprocessParams& params);

/// How many of the handles that were cut are those of a length that the parameters give: not by default.
int asked_cuts(const RepairCounts& counts, const PreprocessParams& params);

/// Whether these repairs, of a mesh with so many faces, leave the surface's form as it was, but for what the
/// parameters asked for: vertices welded, or no more than a few faces, edges, vertices or specks repaired and
/// a few components joined. Of others the user should look at the map. (Holes are never filled without being
/// asked for.)
bool keeps_the_form(const RepairCounts& counts, int faces, const PreprocessParams& params);

/// The target edge length in units of sqrt(area): the parameter, or the automatic choice
/// h = 2 * 1.0746 / sqrt(max(vertices, 2500)). 1.0746 / sqrt(n) is the edge of an even triangulation of unit
/// area with n vertices.
double target_edge_length(const PreprocessParams& params, int used_vertices);

}  // namespace varimap
