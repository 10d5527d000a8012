#include "varimap/sliding/laid_out.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "varimap/core/plane.h"

namespace varimap {

Lie laid_out(const std::array<SeenSide, 3>& sides) {
    Lie lie;
    double sum = 0, size = 0, longest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec2 &ahead = sides[k].first, &back = sides[(k + 2) % 3].second;
        const double twice_area = cross(ahead, back);
        sum += twice_area;
        size += std::abs(twice_area);
        longest = std::max(longest, ahead.squaredNorm());
        lie.turns[k] = std::atan2(twice_area, ahead.dot(back));
    }
    // Where all sides lie along each other, what is left of the areas is rounding.
    lie.sense = size > 1e-11 * longest ? sum / size : std::numeric_limits<double>::quiet_NaN();
    return lie;
}

}  // namespace varimap
