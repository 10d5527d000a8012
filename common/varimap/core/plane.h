#pragma once

#include "varimap/core/linear_algebra.h"

namespace varimap {

/// Twice the signed area of the triangle that two vectors of the plane span: positive where b is to the left.
inline double cross(const Vec2& a, const Vec2& b) {
    return a.x() * b.y() - a.y() * b.x();
}

}  // namespace varimap
