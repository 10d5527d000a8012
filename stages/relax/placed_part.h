#pragma once

#include "stages/relax/relax.h"
#include "varimap/mesh/part_region.h"

namespace varimap {

/// The map of a part and its whole, which is cut to where varimap-locate placed the part: relax (relax.h)
/// from the plan, and, where the way there and back leads far from where it began or much is reversed, from
/// where the part was placed, too, if it is hardly strained there; what is less so is kept. A plan knows
/// areas and costs of the cut surfaces, whose ragged rims may lead it astray; a placement knows that the part
/// is one piece, but not that it covers what is left. Throws ArtifactError for a region of another part.
SurfaceMap relax_part(const Surface& A, const Surface& B, const PairRecord& record, const MapPair& planned,
                      const PartRegion& region, double area_bound, const RelaxParams& params = {});

}  // namespace varimap
