#pragma once

#include <limits>

#include "varimap/sliding/sliding_map.h"

namespace varimap {

/// What `density` says of an image triangle of these q and D, and the more of the area term that its face
/// has.
template <class Density>
double density_with_area_weight(const Density& density, const RestTriangle& rest, double q, double D) {
    const double value = density.value(q, D);
    return rest.area_weight > 0 ? value + rest.area_weight * density.area_value(D) : value;
}

/// Energy of a mapped face: its rest area times what `density` (FoldEnergy or RobustEnergy) says of its image
/// triangle, and the more of the area term that the face has.
template <class Density>
double face_energy(const SlidingMap& map, int f, const Density& density) {
    const ImageTriangle image = map.image_triangle(f);
    return map.rest(f).area * density_with_area_weight(density, map.rest(f), image.q, image.D);
}

/// The sum over those of `faces` (a range of int) that are mapped. Once it gets to `limit`, faces that follow
/// are left out.
template <class FaceRange, class Density>
double total_energy(const SlidingMap& map, const FaceRange& faces, const Density& density,
                    double limit = std::numeric_limits<double>::infinity()) {
    double sum = 0;
    for (const int f : faces) {
        if (sum >= limit) break;
        if (map.is_mapped(f)) sum += face_energy(map, f, density);
    }
    return sum;
}

/// The mean over the mapped faces, per area; 0 where there are none.
template <class Density>
double mean_energy(const SlidingMap& map, const Density& density) {
    double sum = 0, area = 0;
    for (int f = 0; f < map.source().face_count(); ++f) {
        if (!map.is_mapped(f)) continue;
        sum += face_energy(map, f, density);
        area += map.rest(f).area;
    }
    return area > 0 ? sum / area : 0;
}

/// Derivatives of a face's q and D by the position x_i of its corner i's image, j and k the corners after it:
///     a dq/dx_i = c_k (x_i - x_j) + c_j (x_i - x_k),   2a dD/dx_i = up x (x_k - x_j)
/// with the rest area a and cotangents c, for a fixed mean normal. The second derivatives of q are
/// (c_j + c_k) / a by x_i twice and -c_k / a by x_i and x_j, times the identity; D is taken as linear.
struct CornerGradient {
    Vec3 q, D;  ///< a dq/dx_i and 2a dD/dx_i
};
/// x, y, z: x_i, x_j, x_k.
inline CornerGradient corner_gradient(double cj, double ck, const Vec3& x, const Vec3& y, const Vec3& z,
                                      const Vec3& up) {
    return {ck * (x - y) + cj * (x - z), up.cross(z - y)};
}
inline CornerGradient corner_gradient(const SlidingMap& map, int f, int i, const ImageTriangle& image) {
    const auto corners = map.source().faces.row(f);
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const RestTriangle& rest = map.rest(f);
    return corner_gradient(rest.cotangent[j], rest.cotangent[k], map.image(corners[i]), map.image(corners[j]),
                           map.image(corners[k]), image.up);
}

/// What the gradients of q and D add to the Hessian of an energy f(q, D):
///     f_qD (q D' + D q') + f_DD D D'.
template <class Vector>
auto gradient_products(const Vector& q, const Vector& D, double f_qD, double f_DD) {
    return (f_qD * (q * D.transpose() + D * q.transpose()) + f_DD * D * D.transpose()).eval();
}

/// Gradient and Hessian of a term by the tangent coordinates of the images of a face's corners, two each.
struct FaceDerivatives {
    Eigen::Matrix<double, 6, 1> gradient;
    Eigen::Matrix<double, 6, 6> hessian;
};

}  // namespace varimap
