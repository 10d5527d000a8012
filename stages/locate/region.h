#pragma once

#include <vector>

#include "stages/locate/sides.h"

namespace varimap {

/// The faces of the whole's input where the part lies, tidied (part_region.h), ascending: those that it
/// covers (covered.h), and those around landmarks. A landmark that lies outside though the part is hardly
/// strained is one at its rim, or near it: a strip joins it to the rest, with a warning. Throws InputError
/// where a landmark lies outside all the same.
std::vector<int> region_of(const Placement& placement, const Sides& sides);

}  // namespace varimap
