#pragma once

#include <array>

#include "varimap/geodesics/log_map.h"

namespace varimap {

/// How a triangle lies along a surface.
struct Lie {
    /// Which way round it goes: the sum of its signed areas as laid out from each corner, by the sum of their
    /// sizes. 1 where all are counter-clockwise from outside, -1 where clockwise, between where they differ,
    /// because it lies around a bend. NaN where two corners are not connected or as far apart along the
    /// surface as torn triangles have them, or it has no area.
    double sense;
    /// Angle at each corner from the side that leaves it to the one that comes in; negative if clockwise.
    std::array<double, 3> turns;
};

/// The other end of a side as seen from the one along the surface, and the one from the other (log_map.h).
using SeenSide = std::pair<Vec2, Vec2>;

/// A triangle of surface points as it lies along the surface, whatever a straight triangle between them would
/// cut through: its sides, from each corner to the next, are shortest paths.
Lie laid_out(const std::array<SeenSide, 3>& sides);

}  // namespace varimap
