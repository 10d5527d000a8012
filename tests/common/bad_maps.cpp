#include "common/bad_maps.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "common/map_shapes.h"
#include "common/mesh/closest_point.h"
#include "common/mesh/surface_walk.h"

namespace varimap::shapes {

namespace {

/// Two directions of the plane of a face.
Eigen::Matrix<double, 3, 2> plane(const TriangleMesh& mesh, int face) {
    Eigen::Matrix<double, 3, 2> axes;
    axes.col(0) = (mesh.vertex(mesh.faces(face, 1)) - mesh.vertex(mesh.faces(face, 0))).normalized();
    axes.col(1) = face_normal(mesh, face).normalized().cross(axes.col(0));
    return axes;
}

}  // namespace

double longest_edge(const TriangleMesh& mesh) {
    double longest = 0;
    for (int f = 0; f < mesh.face_count(); ++f)
        for (int k = 0; k < 3; ++k)
            longest = std::max(
                longest, (mesh.vertex(mesh.faces(f, k)) - mesh.vertex(mesh.faces(f, (k + 1) % 3))).norm());
    return longest;
}

double mean_error(const PointMap& map, const TriangleMesh& target, const std::vector<char>& marks) {
    double sum = 0;
    int count = 0;
    for (int v = 0; v < int(map.size()); ++v) {
        if (!marks[std::size_t(v)]) continue;
        sum += (position(target, map[std::size_t(v)]) - target.vertex(v)).norm();
        ++count;
    }
    return sum / count;
}

double mean_error(const PointMap& map, const TriangleMesh& target) {
    return mean_error(map, target, std::vector<char>(map.size(), 1));
}

PointMap noisy_identity(const TriangleMesh& mesh, double noise) {
    PointMap map = at_vertices(mesh);
    const SurfaceWalk walk(mesh);
    std::mt19937 random(5);
    const double reach = noise * longest_edge(mesh) / 4294967296.0;
    for (SurfacePoint& point : map) {
        const double angle = 2 * std::numbers::pi * random() / 4294967296.0, length = reach * random();
        point =
            walk(point, plane(mesh, point.face) * length * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    }
    return map;
}

void mirror_patch(PointMap& map, const TriangleMesh& mesh, int centre, double radius) {
    const SurfaceWalk walk(mesh);
    const SurfacePoint middle = at_vertices(mesh)[std::size_t(centre)];
    const auto axes = plane(mesh, middle.face);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const Vec3 offset = mesh.vertex(v) - mesh.vertex(centre);
        const Eigen::Vector2d flat = axes.transpose() * offset;
        if (offset.norm() > radius || offset.dot(axes.col(0).cross(axes.col(1))) < -radius / 2) continue;
        map[std::size_t(v)] = walk(middle, axes * Eigen::Vector2d(-flat.x(), flat.y()));
    }
}

std::vector<char> on_leg(const TriangleMesh& figure) {
    std::vector<char> marks(std::size_t(figure.vertex_count()));
    for (int v = 0; v < figure.vertex_count(); ++v) {
        const Vec3 p = figure.vertex(v);
        marks[std::size_t(v)] = p.x() > 0 && p.y() > 0 && p.z() < leg_origin.z();
    }
    return marks;
}

PointMap with_leg(const TriangleMesh& figure, const std::function<Vec3(const Vec3& p)>& move) {
    const ClosestPoint closest(figure);
    const std::vector<char> leg = on_leg(figure);
    PointMap map = at_vertices(figure);
    for (int v = 0; v < figure.vertex_count(); ++v)
        if (leg[std::size_t(v)]) map[std::size_t(v)] = closest(move(figure.vertex(v))).point;
    return map;
}

PointMap twisted_leg(const TriangleMesh& figure, double turns) {
    return with_leg(figure, [&](const Vec3& p) -> Vec3 {
        const double share = std::clamp((leg_origin.z() - p.z()) / 0.6, 0.0, 1.0);
        return leg_origin +
               Eigen::AngleAxisd(2 * std::numbers::pi * turns * share, leg_axis) * (p - leg_origin);
    });
}

PointMap mirrored_leg(const TriangleMesh& figure) {
    const Vec3 across = leg_axis.cross(Vec3::UnitX()).normalized();
    return with_leg(figure,
                    [&](const Vec3& p) -> Vec3 { return p - 2 * across.dot(p - leg_origin) * across; });
}

PointMap crumpled_leg(const TriangleMesh& figure) {
    std::mt19937 random(7);
    const auto draw = [&] { return random() / 4294967296.0; };
    return with_leg(figure, [&](const Vec3&) -> Vec3 {
        const double along = draw(), angle = 2 * std::numbers::pi * draw();
        return leg_origin + along * leg_axis + 0.2 * Vec3(std::cos(angle), std::sin(angle), 0);
    });
}

}  // namespace varimap::shapes
