#include "varimap/relaxation/laid_out.h"

#include <cmath>

#include "varimap/core/plane.h"

namespace varimap {

Lie laid_out(const std::array<SeenSide, 3>& sides) {
    using Vec2 = LogMap::Vec2;
    Lie lie;
    double sum = 0, size = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec2 &ahead = sides[k].first, &back = sides[(k + 2) % 3].second;
        const double twice_area = cross(ahead, back);
        sum += twice_area;
        size += std::abs(twice_area);
        lie.turns[k] = std::atan2(twice_area, ahead.dot(back));
    }
    lie.sense = sum / size;
    return lie;
}

}  // namespace varimap
