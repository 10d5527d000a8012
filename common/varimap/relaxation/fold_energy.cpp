#include "varimap/relaxation/fold_energy.h"

#include <cmath>

#include "varimap/quality/image_mesh.h"

namespace varimap {

namespace {

constexpr double aligned =
    0.5;  ///< cosine from which on the normal of an image triangle counts as that of the target

}  // namespace

double FoldEnergy::chi(double D) const {
    const double root = std::sqrt(D * D + regularisation * regularisation);
    // The second form has no cancellation where D is negative.
    return D >= 0 ? (D + root) / 2 : regularisation * regularisation / (2 * (root - D));
}

double FoldEnergy::value(double q, double D) const {
    return (q + weight * (1 + D * D)) / (2 * chi(D));
}

FoldEnergy::Value FoldEnergy::derivatives(double q, double D) const {
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

double RobustEnergy::value(double q, double D) const {
    const double x = excess(energy.value(q, D));
    return robustness > 0 ? robustness * std::log1p(x / robustness) : x;
}

FaceData<RestTriangle> rest_triangles(const TriangleMesh& source) {
    FaceData<RestTriangle> rest(source.face_count());
    for (int f = 0; f < source.face_count(); ++f) {
        if (is_degenerate(source, f)) continue;
        const double twice = face_normal(source, f).norm();
        rest[f].area = twice / 2;
        for (int k = 0; k < 3; ++k) {
            const Vec3 p = source.vertex(source.faces(f, k));
            const Vec3 a = source.vertex(source.faces(f, (k + 1) % 3)) - p;
            const Vec3 b = source.vertex(source.faces(f, (k + 2) % 3)) - p;
            rest[f].cotangent[k] = a.dot(b) / twice;
        }
    }
    return rest;
}

ImageTriangle::ImageTriangle(const RestTriangle& rest, const Vec3& x0, const Vec3& x1, const Vec3& x2,
                             const Vec3& m) {
    const Vec3 e0 = x2 - x1, e1 = x0 - x2, e2 = x1 - x0;
    q = (rest.cotangent[0] * e0.squaredNorm() + rest.cotangent[1] * e1.squaredNorm() +
         rest.cotangent[2] * e2.squaredNorm()) /
        (2 * rest.area);
    const Vec3 n = e2.cross(-e1);
    const double size = n.norm();
    if (n.dot(m) > aligned * size)
        up = n / size;
    else
        up = m / aligned;
    D = n.dot(up) / (2 * rest.area);
}

}  // namespace varimap
