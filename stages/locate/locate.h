#pragma once

#include "stages/locate/params.h"
#include "varimap/multilevel/pair_context.h"
#include "varimap/surface/part_region.h"

namespace varimap {

struct Located {
    PartRegion region;
    double share = 0;   ///< of the whole's area that the region has
    double scale = 1;   ///< lengths of the whole's file over those of the part's
    double strain = 0;  ///< of the part that was placed there (placement.h)
    double lead = 0;    ///< over the best place elsewhere (search.h); infinite where landmarks decided
};

/// Where a part lies on its whole: found on sketches (search.h), placed there once more on the surfaces; the
/// region is what the part covers then (covered.h), tidied up. `landmarks`: vertices of the surfaces' meshes.
/// Warns where the part is strained much, and of landmarks that look exchanged: where it is strained at all,
/// it is placed a second time with the likeliest of them exchanged, and has to be strained by less than half
/// as much. With fewer than three landmarks the files have to be in the same units; warns where the part
/// would be elsewhere nearly as well. Throws InputError where a landmark lies outside of the region, and
/// where sizes cannot be the same units'.
Located locate(const PairContext& sketches, const Surface& A, const Surface& B,
               const VertexPairs<MeshVertex>& landmarks, const LocateParams& params);

}  // namespace varimap
