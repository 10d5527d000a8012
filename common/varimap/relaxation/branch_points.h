#pragma once

#include <vector>

#include "varimap/relaxation/sliding_map.h"

namespace varimap {

/// How many times the images of the faces around a vertex go around its image, as seen along the target's
/// normals there: 1 for a map that is one to one, 2 at a branch point, where two sheets of the map hang
/// together though no face need be reversed. 0 on a boundary, and where a face has no image.
double winding_number(const SlidingMap& map, int v);

/// Those of `vertices` where the map goes around twice or more.
std::vector<int> branch_points(const SlidingMap& map, const std::vector<int>& vertices);

}  // namespace varimap
