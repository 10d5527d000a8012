#pragma once

#include "varimap/sliding/sliding_map.h"

namespace varimap {

/// Front propagation (Sec. 4.4): places the images of the vertices with open[v] anew, as an isometry would
/// continue the map of the others, whatever their images were. Ring by ring, a vertex goes where the faces it
/// shares with placed vertices put it, unfolded onto the target; then the last rings are relaxed. Orientation
/// and the turn of a limb about its axis are thus those of the surroundings: flips and twists cannot survive.
/// Vertices that no front reaches keep their images. `scale`: lengths of the images / those of the source.
void continue_map(SlidingMap& map, const VertexData<bool>& open, double scale);

}  // namespace varimap
