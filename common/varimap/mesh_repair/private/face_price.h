#pragma once

#include "varimap/mesh/thin_faces.h"

namespace varimap {

/// What it costs to close a mesh by a face: its area, and about twice `price` more where its thinness
/// (thin_faces.h) is below .02.
inline double price_of_face(const Vec3& a, const Vec3& b, const Vec3& c, double price) {
    constexpr double thin = 0.02;
    const double t = thinness(a, b, c);
    return (b - a).cross(c - b).norm() / 2 + (t < thin ? price * (2 - t) : 0);
}

}  // namespace varimap
