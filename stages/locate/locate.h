#pragma once

#include "stages/locate/params.h"
#include "varimap/mesh/part_region.h"
#include "varimap/multilevel/pair_context.h"

namespace varimap {

/// Where a part lies on its whole.
struct Place {
    PartRegion region;  ///< of the whole's input
    double share = 0;   ///< of the whole's area that the region has
    double scale = 1;   ///< lengths of the whole's file over those of the part's
    double strain = 0;  ///< of the part that was placed there (placed_part.h)
};

/// The place of a part on its whole: found on sketches (search.h), placed there once more on the surfaces,
/// and what the part covers then (covered.h), tidied up. `landmarks`: vertices of the surfaces' meshes.
/// Throws UsageError where there are fewer than three.
Place locate(const PairContext& sketches, const Surface& A, const Surface& B,
             const VertexPairs<MeshVertex>& landmarks, const LocateParams& params);

}  // namespace varimap
