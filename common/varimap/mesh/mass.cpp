#include "varimap/mesh/mass.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace varimap {
namespace {

/// Shares of a face's corners in its area. `area` must be positive.
Vec3 corner_areas(const Vec3& a, const Vec3& b, const Vec3& c, double area) {
    const Vec3 dot((b - a).dot(c - a), (c - b).dot(a - b), (a - c).dot(b - c));
    for (int i = 0; i < 3; ++i) {
        if (dot[i] >= 0) continue;
        Vec3 shares = Vec3::Constant(area / 4);
        shares[i] = area / 2;
        return shares;
    }
    // The parts beside the perpendicular bisectors: corner i gets (|ij|^2 cot k + |ik|^2 cot j) / 8.
    const Vec3 cotangent = dot / (2 * area);
    const Vec3 opposite((b - c).squaredNorm(), (c - a).squaredNorm(), (a - b).squaredNorm());
    const Vec3 part = cotangent.cwiseProduct(opposite) / 8;
    return Vec3(part[1] + part[2], part[2] + part[0], part[0] + part[1]);
}

}  // namespace

Eigen::VectorXd voronoi_masses(const TriangleMesh& mesh) {
    Eigen::VectorXd mass = Eigen::VectorXd::Zero(mesh.vertex_count());
    std::vector<char> used(mesh.vertex_count(), 0);
    for (int f = 0; f < mesh.face_count(); ++f) {
        const auto corner = mesh.faces.row(f);
        for (int c = 0; c < 3; ++c) used[corner[c]] = 1;
        const double area = face_normal(mesh, f).norm() / 2;
        if (!(area > 0)) continue;
        const Vec3 areas =
            corner_areas(mesh.vertex(corner[0]), mesh.vertex(corner[1]), mesh.vertex(corner[2]), area);
        for (int c = 0; c < 3; ++c) mass[corner[c]] += areas[c];
    }
    const double least = 1e-12 * mass.sum() / std::max<double>(1, mass.size());
    for (int v = 0; v < mesh.vertex_count(); ++v)
        if (used[v]) mass[v] = std::max(mass[v], least);
    return mass / mass.sum();
}

VertexData<double> vertex_areas(const TriangleMesh& mesh) {
    VertexData<double> areas(mesh.vertex_count(), 0);
    for (int f = 0; f < mesh.face_count(); ++f)
        for (int k = 0; k < 3; ++k) areas[mesh.faces(f, k)] += face_normal(mesh, f).norm() / 6;
    return areas;
}

Vec3 area_centroid(const TriangleMesh& mesh) {
    // Relative to a corner of the surface, so that a mesh far from the origin loses no digits.
    const Vec3 reference = mesh.vertex(mesh.faces(0, 0));
    Vec3 moment = Vec3::Zero();
    double total = 0;
    for (int f = 0; f < mesh.face_count(); ++f) {
        const double area = face_normal(mesh, f).norm();
        for (int c = 0; c < 3; ++c) moment += area / 3 * (mesh.vertex(mesh.faces(f, c)) - reference);
        total += area;
    }
    return reference + moment / total;
}

double equilateral_edge(const TriangleMesh& mesh) {
    return std::sqrt(4 / std::sqrt(3.0) / mesh.face_count());
}

}  // namespace varimap
