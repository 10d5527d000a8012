#include "varimap/spectral/laplacian.h"

#include <array>
#include <vector>

namespace varimap {

namespace {

/// Cotangents of the three corner angles of a face; zero for a face without area.
std::array<double, 3> corner_cotangents(const TriangleMesh& mesh, int f) {
    std::array<double, 3> cot{};
    const double twice_area = face_normal(mesh, f).norm();
    if (twice_area <= 0) return cot;
    for (int c = 0; c < 3; ++c) {
        const Vec3 corner = mesh.vertex(mesh.faces(f, c));
        const Vec3 u = mesh.vertex(mesh.faces(f, (c + 1) % 3)) - corner;
        const Vec3 v = mesh.vertex(mesh.faces(f, (c + 2) % 3)) - corner;
        // A needle's cotangent can exceed what the eigensolver can bear; 1e6 is an angle of a microradian.
        cot[c] = std::clamp(u.dot(v) / twice_area, -1e6, 1e6);
    }
    return cot;
}

}  // namespace

Eigen::SparseMatrix<double> cotangent_laplacian(const TriangleMesh& mesh) {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(12 * size_t(mesh.face_count()));
    for (int f = 0; f < mesh.face_count(); ++f) {
        const auto cot = corner_cotangents(mesh, f);
        for (int c = 0; c < 3; ++c) {
            const int i = mesh.faces(f, (c + 1) % 3), j = mesh.faces(f, (c + 2) % 3);
            const double half = cot[c] / 2;
            entries.emplace_back(i, j, -half);
            entries.emplace_back(j, i, -half);
            entries.emplace_back(i, i, half);
            entries.emplace_back(j, j, half);
        }
    }
    Eigen::SparseMatrix<double> L(mesh.vertex_count(), mesh.vertex_count());
    L.setFromTriplets(entries.begin(), entries.end());
    return L;
}

}  // namespace varimap
