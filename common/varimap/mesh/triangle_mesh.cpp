#include "varimap/mesh/triangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "varimap/mesh/face_geometry.h"

namespace varimap {

PointPairs swapped(const PointPairs& pairs) {
    PointPairs result;
    result.reserve(pairs.size());
    for (const auto& [first, second] : pairs) result.emplace_back(second, first);
    return result;
}

bool are_points(const PointMap& points, int faces) {
    constexpr double rounding = 1e-6;  // of coordinates that were clamped
    return std::all_of(points.begin(), points.end(), [&](const SurfacePoint& point) {
        const Vec3& b = point.barycentric;
        if (point.face == -1) return true;
        return point.face >= 0 && (faces < 0 || point.face < faces) && b.allFinite() &&
               b.minCoeff() >= -rounding && std::abs(b.sum() - 1) <= rounding;
    });
}

bool is_map_between(const PointMap& map, const TriangleMesh& source, const TriangleMesh& target) {
    return int(map.size()) == source.vertex_count() && are_points(map, target.face_count());
}

Box bounding_box(const TriangleMesh& mesh) {
    Box box{Vec3::Constant(std::numeric_limits<double>::infinity()),
            Vec3::Constant(-std::numeric_limits<double>::infinity())};
    for (const int v : mesh.faces.reshaped()) {
        box.low = box.low.cwiseMin(mesh.vertex(v));
        box.high = box.high.cwiseMax(mesh.vertex(v));
    }
    return box;
}

double surface_area(const TriangleMesh& mesh) {
    double twice = 0;
    for (int f = 0; f < mesh.face_count(); ++f) twice += face_normal(mesh, f).norm();
    return twice / 2;
}

Points vertex_normals(const TriangleMesh& mesh) {
    Points normals = Points::Zero(mesh.vertex_count(), 3);
    for (int f = 0; f < mesh.face_count(); ++f) {
        const Vec3 n = face_normal(mesh, f);
        if (n.norm() == 0) continue;
        for (int c = 0; c < 3; ++c) {
            const Vec3 p = mesh.vertex(mesh.faces(f, c));
            const Vec3 a = mesh.vertex(mesh.faces(f, (c + 1) % 3)) - p;
            const Vec3 b = mesh.vertex(mesh.faces(f, (c + 2) % 3)) - p;
            const double angle = angle_between(a, b);
            normals.row(mesh.faces(f, c)) += angle * n.normalized().transpose();
        }
    }
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const double length = normals.row(v).norm();
        if (length > 0) normals.row(v) /= length;
    }
    return normals;
}

}  // namespace varimap
