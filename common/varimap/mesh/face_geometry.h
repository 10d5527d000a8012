#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// The angle between two vectors, in [0, pi]; accurate for small and for blunt ones.
inline double angle_between(const Vec3& a, const Vec3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Length of a face's longest edge.
inline double longest_edge(const TriangleMesh& mesh, int f) {
    const Vec3 a = mesh.vertex(mesh.faces(f, 0)), b = mesh.vertex(mesh.faces(f, 1)),
               c = mesh.vertex(mesh.faces(f, 2));
    return std::sqrt(std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()}));
}

/// Area of some faces together, in units of the mesh squared.
inline double area_of(const TriangleMesh& mesh, const std::vector<int>& faces) {
    double area = 0;
    for (const int f : faces) area += face_normal(mesh, f).norm() / 2;
    return area;
}

/// Cotangents of a face's angles, by corner. Its area must be positive.
inline Vec3 corner_cotangents(const TriangleMesh& mesh, int f) {
    const double twice_area = face_normal(mesh, f).norm();
    Vec3 cotangents;
    for (int k = 0; k < 3; ++k) {
        const Vec3 p = mesh.vertex(mesh.faces(f, k));
        const Vec3 a = mesh.vertex(mesh.faces(f, (k + 1) % 3)) - p;
        const Vec3 b = mesh.vertex(mesh.faces(f, (k + 2) % 3)) - p;
        cotangents[k] = a.dot(b) / twice_area;
    }
    return cotangents;
}

/// The corner of its face with the largest barycentric coordinate of a point; -1 for nowhere.
inline int nearest_vertex(const TriangleMesh& mesh, const SurfacePoint& point) {
    if (point.face < 0) return -1;
    int corner;
    point.barycentric.maxCoeff(&corner);
    return mesh.faces(point.face, corner);
}

}  // namespace varimap
