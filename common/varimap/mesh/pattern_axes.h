#pragma once

#include <array>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// The coordinate axes in an order for colours that are to be told apart: last the one from left to right, as
/// far as can be told: of those that do not point up, the shorter, unless the surface is clearly more even
/// across the other; before it the longer of the rest, then the shorter. Deterministic.
std::array<int, 3> pattern_axes(const TriangleMesh& mesh);

/// Sum of the areas of the faces' projections along each axis.
Vec3 projected_areas(const TriangleMesh& mesh);
/// The axis that most likely points up, y (1) or z (2): surfaces that show most along the one have the other
/// upright; of those that show most along x, the axis on which they stand on zero, else the shorter one, as
/// four-legged animals do.
int likely_up(const TriangleMesh& mesh);

}  // namespace varimap
