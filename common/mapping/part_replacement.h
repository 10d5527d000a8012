#pragma once

#include <vector>

#include "common/mapping/moving_map.h"

namespace varimap {

/// Which parts of a map are suspected, and how the alternatives are judged.
struct PartReplacementOptions {
    double excess = 0.12;      ///< mean excess energy (fold_energy.h) around a face that belongs to a strained part
    double area = 2e-4;        ///< share of the source's area of the smallest part that is tried
    double robustness = 0.3;   ///< of the energy by which maps are compared
    double gain = 0.02;        ///< share of the part's energy an alternative must save
    int most_parts = 16;
};

struct PartReplacementReport {
    int tried = 0, replaced = 0;
    double area_percent = 0;  ///< share of the source's area in replaced parts
};

/// Mirrored and twisted limbs: a relaxed map is strained where it cannot pass over into its surroundings. Each
/// strained part, widened by some of its surroundings and by what it cuts off, is mapped anew as the
/// continuation of the rest of the map (continuation.h) and relaxed; the new map is kept where its energy is
/// lower. fixed[v]: landmarks, which keep their images.
PartReplacementReport replace_strained_parts(MovingMap& map, const std::vector<char>& fixed,
                                             const PartReplacementOptions& options);

}  // namespace varimap
