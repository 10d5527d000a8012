#include "varimap/spectral/laplacian.h"

#include <vector>

#include "varimap/mesh/face_geometry.h"

namespace varimap {

namespace {

/// Zero for a face without area.
Vec3 bounded_cotangents(const TriangleMesh& mesh, int f) {
    if (face_normal(mesh, f).norm() <= 0) return Vec3::Zero();
    // A needle's cotangent can exceed what the eigensolver can bear; 1e6 is an angle of a microradian. All
    // three by one factor: energies stay positive.
    constexpr double most = 1e6;
    const Vec3 cotangents = corner_cotangents(mesh, f);
    const double largest = cotangents.cwiseAbs().maxCoeff();
    return largest > most ? Vec3(most / largest * cotangents) : cotangents;
}

using Entries = std::vector<Eigen::Triplet<double>>;

/// The energy weight (f_i - f_j)^2.
void join(int i, int j, double weight, Entries& entries) {
    entries.emplace_back(i, j, -weight);
    entries.emplace_back(j, i, -weight);
    entries.emplace_back(i, i, weight);
    entries.emplace_back(j, j, weight);
}

Eigen::SparseMatrix<double> matrix_of(const Entries& entries, int size) {
    Eigen::SparseMatrix<double> L(size, size);
    L.setFromTriplets(entries.begin(), entries.end());
    return L;
}

}  // namespace

Eigen::SparseMatrix<double> cotangent_laplacian(const TriangleMesh& mesh) {
    Entries entries;
    entries.reserve(12 * size_t(mesh.face_count()));
    for (int f = 0; f < mesh.face_count(); ++f) {
        const Vec3 cot = bounded_cotangents(mesh, f);
        for (int c = 0; c < 3; ++c)
            join(mesh.faces(f, (c + 1) % 3), mesh.faces(f, (c + 2) % 3), cot[c] / 2, entries);
    }
    return matrix_of(entries, mesh.vertex_count());
}

Eigen::SparseMatrix<double> laplacian(const Domain& domain) {
    if (domain.is_surface()) return cotangent_laplacian(domain.mesh);
    Entries entries;
    for (const DomainEdge& edge : domain.edges) join(edge.a, edge.b, edge.conductance, entries);
    return matrix_of(entries, domain.mesh.vertex_count());
}

}  // namespace varimap
