#include "stages/generate/random.h"

#include <cmath>
#include <numbers>

namespace varimap::shapes {

using std::numbers::pi;

Vec3 Random::direction() {
    const double z = between(-1, 1), turn = between(0, 2 * pi), r = std::sqrt(1 - z * z);
    return {r * std::cos(turn), r * std::sin(turn), z};
}

Eigen::Matrix3d Random::rotation() {
    const Vec3 axis = direction();
    return Eigen::AngleAxisd(between(0, pi), axis).toRotationMatrix();
}

}  // namespace varimap::shapes
