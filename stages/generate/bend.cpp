#include "stages/generate/bend.h"

#include <algorithm>
#include <cmath>

namespace varimap::shapes {

bool Bend::applies(const Vec3& p) const {
    return p.cwiseProduct(octant).minCoeff() >= 0;
}

Vec3 Bend::forward(const Vec3& p) const {
    const Vec3 local = p - origin;
    const double x = axis.dot(local) - start, y = direction.dot(local);
    if (x <= 0 || angle == 0 || !applies(p)) return p;
    const double radius = length / angle, turn = std::min(x, length) / radius,
                 rest = std::max(0.0, x - length);
    const double c = std::cos(turn), s = std::sin(turn);
    const double new_x = (radius - y) * s + rest * c, new_y = radius - (radius - y) * c + rest * s;
    return p + (new_x - x) * axis + (new_y - y) * direction;
}

Vec3 Bend::inverse(const Vec3& p) const {
    const Vec3 local = p - origin;
    const double u = axis.dot(local) - start, v = direction.dot(local);
    if (angle == 0 || !applies(p)) return p;
    const double radius = length / angle;
    // Around the centre (0, radius) of the arc the angle from the vertical is the turn; beyond the arc the
    // rest is rigid.
    const double side = radius > 0 ? 1 : -1, turn = std::atan2(side * u, side * (radius - v));
    if (turn * side <= 0) return p;
    double x = turn * radius, y = radius - side * std::hypot(u, radius - v);
    if (std::abs(turn) > std::abs(angle)) {
        const double c = std::cos(angle), s = std::sin(angle);
        const double du = u - radius * s, dv = v - (radius - radius * c);
        x = length + du * c + dv * s;
        y = -du * s + dv * c;
    }
    return p + (x - u) * axis + (y - v) * direction;
}

}  // namespace varimap::shapes
