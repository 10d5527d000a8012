#pragma once

#include "stages/relax/params.h"
#include "varimap/results/read_out.h"
#include "varimap/results/surface_map.h"
#include "varimap/surface/surface.h"

namespace varimap {

/// The map in both directions on the INPUT meshes: `maps` (read_out.h) are those of the preprocessed
/// surfaces' vertices. These are untangled on the input faces (untangling.h), where the input's vertices are
/// the first of them; of surfaces that were coarsened, or most of whose vertices bisection made, on the
/// preprocessed meshes first, and then carried over to the inputs (prolongation.h). Points lie on the faces
/// of the mesh files, also where a surface is mirrored.
SurfaceMap relax(const Surface& A, const Surface& B, const PairRecord& record, MapPair maps,
                 double area_bound, const RelaxParams& params = {});

/// Warns of parts that are mirrored in the end and were left as they are.
void warn_of_mirrored_parts(const SurfaceMap& map);

}  // namespace varimap
