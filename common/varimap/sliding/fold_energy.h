#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "varimap/core/indexed.h"
#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// The regularised fold-free energy (Garanzha et al. 2021) of one image triangle, the image of a source
/// triangle of area a:   a (q / 2 + w (1 + D^2) / 2) / chi(D),   chi(D) = (D + sqrt(D^2 + e^2)) / 2,
/// q = |J|_F^2 of the linear map onto the image triangle, D its signed area ratio: with n its normal
/// (twice its area) and m the unit mean of the target's normals at its corners, |n| / (2 a) up to 60 degrees
/// between n and m, beyond n . m / a. For D > 0 and e -> 0: a cosh(log s1 - log s2) + a w cosh(log s1 + log
/// s2) with the singular values s, so least where the map is an isometry; w weighs areas against angles.
struct FoldEnergy {
    double weight = 1;          ///< w
    double regularisation = 1;  ///< e

    /// Value per unit of source area, and the derivatives by q and D. `convex_DD` is the second derivative by
    /// D of the convex part: with f_qD it makes a Hessian that is positive semidefinite.
    struct Value {
        double f, f_q, f_D, f_qD, f_DD, convex_DD;
    };
    double chi(double D) const;
    double value(double q, double D) const;
    Value derivatives(double q, double D) const;
    /// What more of the area term, (1 + D^2) / (2 chi(D)), adds.
    double area_value(double D) const { return (1 + D * D) / (2 * chi(D)); }
    Value area_derivatives(double D) const;
    /// With more weight of the area term.
    FoldEnergy with(double area_weight) const { return {weight + area_weight, regularisation}; }
};

/// By which strained parts are found, and alternatives for parts of a map compared.
inline constexpr FoldEnergy judged_energy{1, 0.1};

/// The excess x of a fold energy (per area) over an isometry's, and its robust function r log(1 + x / r), by
/// which faces that cannot be isometric count less; r = 0: x itself.
struct RobustEnergy {
    FoldEnergy energy;
    double robustness;  ///< r
    double least;       ///< the energy of an isometry

    RobustEnergy(const FoldEnergy& e, double r) : energy(e), robustness(r), least(e.value(2, 1)) {}
    double value(double q, double D) const;
    double area_value(double D) const { return energy.area_value(D); }
    /// Derivative of the value by the fold energy where that is `v`.
    double slope(double v) const { return robustness > 0 ? 1 / (1 + excess(v) / robustness) : 1; }

  private:
    double excess(double v) const { return v > least ? v - least : 0; }
};

/// What the energy needs of a source triangle; area 0: left out.
struct RestTriangle {
    double area = 0;
    Vec3 cotangent = Vec3::Zero();  ///< per corner
    /// Of the area term, beyond that of the energy, and beyond robustness: where a bound presses
    /// (area_bound.h).
    double area_weight = 0;
};
FaceData<RestTriangle> rest_triangles(const TriangleMesh& source);

/// The q and D of an image triangle with corners x0, x1, x2; face_energy.h has their derivatives.
struct ImageTriangle {
    /// Cosine from which on the normal of an image triangle counts as that of the target.
    static constexpr double aligned = 0.5;
    double q = 0, D = 0;
    Vec3 up;  ///< D = n . up / (2 a)
    /// `normals`: a vector of any length along m, such as the sum of the target's normals.
    ImageTriangle(const RestTriangle& rest, const Vec3& x0, const Vec3& x1, const Vec3& x2,
                  const Vec3& normals);
};

// Inline: these are what relaxation does most.

inline double FoldEnergy::chi(double D) const {
    const double root = std::sqrt(D * D + regularisation * regularisation);
    // The second form has no cancellation where D is negative.
    return D >= 0 ? (D + root) / 2 : regularisation * regularisation / (2 * (root - D));
}

inline double FoldEnergy::value(double q, double D) const {
    return (q + weight * (1 + D * D)) / (2 * chi(D));
}

inline FoldEnergy::Value FoldEnergy::derivatives(double q, double D) const {
    const double e2 = regularisation * regularisation, root = std::sqrt(D * D + e2), c = chi(D);
    const double c1 = c / root, c2 = e2 / (2 * root * root * root);
    const double N = (q + weight * (1 + D * D)) / 2, r = c1 / c;
    Value v;
    v.f = N / c;
    v.f_q = 1 / (2 * c);
    v.f_D = (weight * D - N * r) / c;
    v.f_qD = -r / (2 * c);
    v.f_DD = (weight - 2 * weight * D * r + N * (2 * r * r - c2 / c)) / c;
    v.convex_DD = (q * r * r + weight * (r * r + (1 - D * r) * (1 - D * r))) / c;
    return v;
}

inline FoldEnergy::Value FoldEnergy::area_derivatives(double D) const {
    Value v = FoldEnergy{1, regularisation}.derivatives(0, D);
    v.f_q = v.f_qD = 0;
    return v;
}

inline double RobustEnergy::value(double q, double D) const {
    const double x = excess(energy.value(q, D));
    return robustness > 0 ? robustness * std::log1p(x / robustness) : x;
}

inline ImageTriangle::ImageTriangle(const RestTriangle& rest, const Vec3& x0, const Vec3& x1, const Vec3& x2,
                                    const Vec3& normals) {
    const Vec3 e0 = x2 - x1, e1 = x0 - x2, e2 = x1 - x0;
    q = (rest.cotangent[0] * e0.squaredNorm() + rest.cotangent[1] * e1.squaredNorm() +
         rest.cotangent[2] * e2.squaredNorm()) /
        (2 * rest.area);
    const Vec3 n = e2.cross(-e1);
    const double squared = n.squaredNorm(), size = std::sqrt(squared), along = n.dot(normals);
    // Nearly all are aligned beyond doubt about rounding, and need no m.
    constexpr double beyond_doubt = aligned * aligned * (1 + 1e-6);
    if (along > 0 && along * along > beyond_doubt * squared * normals.squaredNorm()) {
        up = n / size;
    } else {
        const Vec3 m = normals.normalized();
        if (n.dot(m) > aligned * size)
            up = n / size;
        else
            up = m / aligned;
    }
    D = n.dot(up) / (2 * rest.area);
}

}  // namespace varimap
