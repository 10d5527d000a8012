#pragma once

#include <Eigen/Geometry>

#include "common/mesh/closest_point.h"
#include "common/mesh/surface.h"

/// Maps and surfaces around a given mesh, for tests of maps.
namespace varimap::shapes {

/// The identity: each vertex as a point on one of its faces.
inline PointMap at_vertices(const TriangleMesh& mesh) {
    PointMap map(std::size_t(mesh.vertex_count()));
    for (int f = 0; f < mesh.face_count(); ++f)
        for (int k = 0; k < 3; ++k) map[std::size_t(mesh.faces(f, k))] = {f, Vec3::Unit(k)};
    return map;
}

/// A closed surface about the origin turned onto itself by `angle`, about an axis askew.
inline PointMap turned_identity(const TriangleMesh& mesh, double angle) {
    const ClosestPoint closest(mesh);
    const Eigen::AngleAxisd turn(angle, Vec3(1, 2, 3).normalized());
    PointMap map;
    for (int v = 0; v < mesh.vertex_count(); ++v) map.push_back(closest(turn * mesh.vertex(v)).point);
    return map;
}

/// A surface whose mesh is its input, with equal masses.
inline Surface plain_surface(const TriangleMesh& mesh) {
    Surface surface;
    surface.mesh = surface.input = mesh;
    surface.mass = Eigen::VectorXd::Constant(mesh.vertex_count(), 1.0 / mesh.vertex_count());
    surface.on_input = at_vertices(mesh);
    for (int v = 0; v < mesh.vertex_count(); ++v) surface.vertex_of_input.push_back(v);
    for (int f = 0; f < mesh.face_count(); ++f) surface.input_face.push_back(f);
    return surface;
}

}  // namespace varimap::shapes
