#include <algorithm>
#include <cmath>

#include "common/shapes.h"

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

Vec3 Pose::forward(Vec3 p) const {
    for (const Bend& bend : bends) p = bend.forward(p);
    return p;
}

Vec3 Pose::inverse(Vec3 p) const {
    for (std::size_t i = bends.size(); i-- > 0;) p = bends[i].inverse(p);
    return p;
}

TriangleMesh Pose::operator()(TriangleMesh rest) const {
    for (int v = 0; v < rest.vertex_count(); ++v) rest.vertices.row(v) = forward(rest.vertex(v)).transpose();
    return rest;
}

Pose tube_pose(double angle) {
    return {{{Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), 1.4, 1.4, angle}}};
}

}  // namespace varimap::shapes
