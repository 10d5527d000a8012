#pragma once

#include <vector>

#include "varimap/multilevel/orientation.h"

namespace varimap {

/// A connected patch of samples at which the map reverses orientation.
struct ReversedPart {
    std::vector<int> samples;
    double mass = 0;
};

/// Connected patches (along the level's neighbourhoods) of samples with negative determinant, that hold at
/// least `minimum_mass`; the largest first.
std::vector<ReversedPart> reversed_parts(const LevelSide& side, const Orientation& orientation,
                                         double minimum_mass);

/// One side of a level with the graph along which distances are measured.
struct GraphedSide {
    const LevelSide& level_side;
    const GeodesicGraph& graph;
};

/// New images for the samples of a reversed part, found from its surroundings alone: anchors are
/// well-oriented samples around the part, and a sample goes to the other side's sample whose geodesic
/// distances to the anchors' images are most like its own distances to the anchors. Anchors all around a limb
/// tell its two sides apart, so the new images keep orientation where the old ones mirrored it. Returns per
/// sample of the part the other side's sample; empty if there are too few anchors.
std::vector<int> reanchored_images(const ReversedPart& part, const Orientation& orientation,
                                   const GraphedSide& from, const GraphedSide& to);

}  // namespace varimap
