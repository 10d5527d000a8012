#pragma once

#include <Eigen/Core>

namespace varimap {

/// Twice the signed area of the triangle that two vectors of the plane span: positive where b is to the left.
inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
}

}  // namespace varimap
