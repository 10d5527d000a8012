#pragma once

#include <string>
#include <vector>

namespace varimap {

/// The name in `names` that differs from `name` by the fewest letters inserted, left out, changed or swapped
/// with their neighbour, for "did you mean"; empty where all differ by more than a third of their letters.
std::string nearest_name(const std::string& name, const std::vector<std::string>& names);

}  // namespace varimap
