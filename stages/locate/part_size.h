#pragma once

#include <vector>

#include "varimap/surface/surface.h"

namespace varimap {

/// How large a part is beside the whole that it belongs to.
struct PartSize {
    double scale = 1;  ///< lengths of the whole's file over those of the part's
    double share = 1;  ///< the part's area over the whole's; above 1 the part is the larger one
};

/// From the shortest paths between landmarks, vertices of both meshes in the same order. Paths of a part lead
/// around what was cut off, so that the upper quartile of their ratios counts; where it differs from 1 by
/// less than its own errors, the files have the same units, and it is 1.
PartSize part_size(const Surface& part, const std::vector<int>& landmarks_part, const Surface& whole,
                   const std::vector<int>& landmarks_whole);

}  // namespace varimap
