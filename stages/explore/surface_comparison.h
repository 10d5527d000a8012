#pragma once

#include <functional>
#include <vector>

#include "stages/explore/finished_pool.h"

namespace varimap {

/// Maps of sketches, in order, of which the first may be the wrong choice: where that is not sure, those that
/// may be right are solved for on the surfaces that were sketched, where more shows. If another is better
/// than the first in the mean of both scores, by more than these err, they are returned with the means and
/// in their order, though still as maps of the sketches; else the list as it is. The surfaces are asked for
/// only where they are needed, and left alone where they have too many vertices.
std::vector<Appraised> compared_on_surfaces(std::vector<Appraised> list, const PairContext& sketches,
                                            const FinishingOptions& options,
                                            const std::function<PairContext()>& ask_surfaces);

}  // namespace varimap
