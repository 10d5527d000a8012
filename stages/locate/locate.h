#pragma once

#include "stages/locate/params.h"
#include "varimap/mesh/part_region.h"
#include "varimap/multilevel/pair_context.h"

namespace varimap {

struct Located {
    PartRegion region;
    double share = 0;   ///< of the whole's area that the region has
    double scale = 1;   ///< lengths of the whole's file over those of the part's
    double strain = 0;  ///< of the part that was placed there (placement.h)
};

/// Where a part lies on its whole: found on sketches (search.h), placed there once more on the surfaces; the
/// region is what the part covers then (covered.h), tidied up. `landmarks`: vertices of the surfaces' meshes.
/// Throws UsageError where there are fewer than three, InputError where one lies outside of the region.
Located locate(const PairContext& sketches, const Surface& A, const Surface& B,
               const VertexPairs<MeshVertex>& landmarks, const LocateParams& params);

}  // namespace varimap
