#pragma once

#include "stages/relax/relax.h"
#include "varimap/surface/part_region.h"

namespace varimap {

/// The map of a part and its whole, which is cut to where varimap-locate placed the part: relax (relax.h)
/// from the plan. Where that map is not in order (its way there and back leads .004 sqrt(area of the part) or
/// more from where it began in the mean, or much is reversed), the place is not doubtful, and no candidate of
/// exploration was continued, relax begins where the part was placed, too, and the map that is more in order
/// is returned. Throws ArtifactError for a region of another part or whole.
SurfaceMap relax_part(const Surface& A, const Surface& B, const PairRecord& record, const MapPair& planned,
                      const PartRegion& region, double area_bound, const RelaxParams& params = {});

}  // namespace varimap
