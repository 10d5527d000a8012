#pragma once

#include "varimap/relaxation/soft_constraints.h"
#include "varimap/sliding/sliding_map.h"

namespace varimap {

/// Of a direction of a map: a limb may have been crushed to its root, by the inverse of a part that was wrong
/// or while folds were removed. Its energy is bounded and its triangles may be upright, but it leaves a part
/// of the target out that the other direction takes to the limb. Where the way there and back ends more than
/// 0.05 sqrt(area) from where it began, images are taken from the other direction, inverted, and relaxed;
/// they are kept if the map then enters more of the target, by 0.4 % of its area and by half of what
/// disagreed: less is gained where the directions are two different maps. Returns whether they were.
/// `back`: the other direction, known. Vertices with fixed[v] stay, `landmarks` hold.
bool recover_missed_parts(SlidingMap& map, const PointMap& back, const VertexData<bool>& fixed,
                          const std::vector<SoftConstraint>& landmarks, double inverse_weight);

/// Images from the other direction, inverted, for the `open` vertices, where the way there and back ends as
/// far from where it began, and a few rings around. Vertices with fixed[v] stay.
void take_from_other_direction(SlidingMap& map, const PointMap& back, VertexData<bool> open,
                               const VertexData<bool>& fixed);

}  // namespace varimap
