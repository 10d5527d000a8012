#include "common/limbs.h"

#include <algorithm>
#include <cmath>

namespace varimap::shapes {

double Limb::distance(const Vec3& p) const {
    const Vec3 axis = b - a;
    const double t = std::clamp((p - a).dot(axis) / axis.squaredNorm(), 0.0, 1.0);
    return (p - a - t * axis).norm() - (ra + t * (rb - ra));
}

double smooth_distance(const std::vector<Limb>& limbs, const Vec3& p) {
    constexpr double blend = 0.06;
    double sum = 0;
    for (const Limb& limb : limbs) sum += std::exp(-limb.distance(p) / blend);
    return -blend * std::log(std::max(sum, 1e-300));
}

}  // namespace varimap::shapes
