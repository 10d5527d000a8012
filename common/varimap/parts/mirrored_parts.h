#pragma once

#include <vector>

#include "varimap/sliding/sliding_map.h"

namespace varimap {

/// When a patch of reversed faces is no tangle but a part (a limb, a side) that the map mirrors.
struct MirrorGate {
    double area = 0.03;     ///< share of the source's area that it has at least
    double ratio = -0.75;   ///< signed image area / source area that it has at most
    double interior = 0.6;  ///< share of its faces whose neighbours are all reversed that it has at least
};

/// A connected patch of reversed faces (D <= 0).
struct ReversedPatch {
    std::vector<int> faces;  ///< ascending
    double area = 0;         ///< share of the source's area
    double ratio = 0;        ///< signed image area / source area
    double interior = 0;     ///< share of its faces whose neighbours are all reversed
};

/// All patches, largest area first.
std::vector<ReversedPatch> reversed_patches(const SlidingMap& map);

/// Whether a patch passes all three of the gate.
inline bool is_mirrored_part(const ReversedPatch& patch, const MirrorGate& gate) {
    return patch.area >= gate.area && patch.ratio <= gate.ratio && patch.interior >= gate.interior;
}

}  // namespace varimap
