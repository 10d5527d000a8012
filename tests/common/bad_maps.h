#pragma once

#include <functional>

#include "common/mesh/triangle_mesh.h"

/// Maps between meshes of the same connectivity whose true map is the identity, damaged in known ways.
namespace varimap::shapes {

double longest_edge(const TriangleMesh& mesh);

/// Mean distance of the images from the target's vertices of the same numbers.
double mean_error(const PointMap& map, const TriangleMesh& target);
/// The same over the vertices with marks[v].
double mean_error(const PointMap& map, const TriangleMesh& target, const std::vector<char>& marks);

/// The identity with every image walked away by up to `noise` edge lengths.
PointMap noisy_identity(const TriangleMesh& mesh, double noise);

/// Mirrors what lies within `radius` of a vertex.
void mirror_patch(PointMap& map, const TriangleMesh& mesh, int centre, double radius);

/// The left foreleg of figure(): where it begins on the axis, and the unit direction to its foot.
inline const Vec3 leg_origin(0.715, 0.275, -0.5);
inline const Vec3 leg_axis = Vec3(0.05, 0.09, -1.05).normalized();
/// Marks the vertices of the leg (z < -0.5).
std::vector<char> on_leg(const TriangleMesh& figure);
/// The identity of a figure, but the vertices of its leg on the points closest to move(p). Valid for any
/// pose.
PointMap with_leg(const TriangleMesh& figure, const std::function<Vec3(const Vec3& p)>& move);
/// The leg turned about its axis, sheared over the first 0.6 of its length.
PointMap twisted_leg(const TriangleMesh& figure, double turns);
/// The leg mirrored in a plane through its axis.
PointMap mirrored_leg(const TriangleMesh& figure);
/// The vertices of the leg anywhere on it.
PointMap crumpled_leg(const TriangleMesh& figure);

}  // namespace varimap::shapes
