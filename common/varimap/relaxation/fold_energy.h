#pragma once

#include <Eigen/Core>

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
};

/// The excess x of a fold energy (per area) over an isometry's, and its robust function r log(1 + x / r), by
/// which faces that cannot be isometric count less; r = 0: x itself.
struct RobustEnergy {
    FoldEnergy energy;
    double robustness;  ///< r
    double least;       ///< the energy of an isometry

    RobustEnergy(const FoldEnergy& e, double r) : energy(e), robustness(r), least(e.value(2, 1)) {}
    double value(double q, double D) const;
    /// Derivative of the value by the fold energy where that is `v`.
    double slope(double v) const { return robustness > 0 ? 1 / (1 + excess(v) / robustness) : 1; }

  private:
    double excess(double v) const { return v > least ? v - least : 0; }
};

/// What the energy needs of a source triangle; area 0: left out.
struct RestTriangle {
    double area = 0;
    Vec3 cotangent = Vec3::Zero();  ///< per corner
};
FaceData<RestTriangle> rest_triangles(const TriangleMesh& source);

/// The q and D of an image triangle with corners x0, x1, x2; face_energy.h has their derivatives.
struct ImageTriangle {
    double q = 0, D = 0;
    Vec3 up;  ///< D = n . up / (2 a)
    ImageTriangle(const RestTriangle& rest, const Vec3& x0, const Vec3& x1, const Vec3& x2, const Vec3& m);
};

}  // namespace varimap
