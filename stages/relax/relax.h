#pragma once

#include "stages/relax/params.h"
#include "varimap/mesh/surface.h"
#include "varimap/results/read_out.h"
#include "varimap/results/surface_map.h"

namespace varimap {

/// The map in both directions on the INPUT meshes: `images` (read_out.h) are those of the preprocessed
/// surfaces' vertices, of which the input vertices are the first; they go to the input faces that hold them,
/// where they are untangled (untangling.h). Where bisection made most of the vertices, the preprocessed
/// surfaces are untangled first: the input alone would be too coarse to find the way. Points lie on the faces
/// of the mesh files, also where a surface is mirrored.
SurfaceMap relax(const Surface& A, const Surface& B, const PairRecord& record, VertexMaps images,
                 double area_bound, const RelaxParams& params = {});

}  // namespace varimap
