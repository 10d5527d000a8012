#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>  // cross()
#include <utility>
#include <vector>

#include "varimap/core/linear_algebra.h"

namespace varimap {

using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;  ///< one point per row
using Faces = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;      ///< one triangle per row

/// The axes that medical programs mean by x, y and z: towards the patient's Left, Posterior, Superior, or
/// Right, Anterior, Superior. The one is the other with x and y negated.
enum class Space : int { unstated = 0, lps = 1, ras = 2 };

/// An indexed triangle mesh. Faces are counter-clockwise seen from outside.
struct TriangleMesh {
    Points vertices;
    Faces faces;
    Space space = Space::unstated;  ///< what its file says of its axes

    int vertex_count() const { return int(vertices.rows()); }
    int face_count() const { return int(faces.rows()); }
    Vec3 vertex(int v) const { return vertices.row(v).transpose(); }
};

/// A point on a surface: a face and barycentric coordinates on its corners (they sum to 1). face -1: nowhere.
struct SurfacePoint {
    int face = -1;
    Vec3 barycentric = Vec3::Zero();
};

/// Images of the vertices of one mesh on another: one point per vertex, in the vertices' order.
using PointMap = std::vector<SurfacePoint>;

/// Whether each is nowhere or has barycentric coordinates in [0, 1] of sum 1; `faces`: their number, if
/// known.
bool are_points(const PointMap& points, int faces = -1);
/// Whether it has a point for each vertex of the source, on faces of the target or nowhere.
bool is_map_between(const PointMap& map, const TriangleMesh& source, const TriangleMesh& target);

/// Points of two surfaces that belong together.
using PointPairs = std::vector<std::pair<SurfacePoint, SurfacePoint>>;
/// Those of the second surface first.
PointPairs swapped(const PointPairs& pairs);

/// Position in space of a surface point.
inline Vec3 position(const TriangleMesh& mesh, const SurfacePoint& p) {
    return p.barycentric[0] * mesh.vertex(mesh.faces(p.face, 0)) +
           p.barycentric[1] * mesh.vertex(mesh.faces(p.face, 1)) +
           p.barycentric[2] * mesh.vertex(mesh.faces(p.face, 2));
}

/// Twice the area vector of a face (not normalised).
inline Vec3 face_normal(const TriangleMesh& mesh, int f) {
    const Vec3 a = mesh.vertex(mesh.faces(f, 0));
    return (mesh.vertex(mesh.faces(f, 1)) - a).cross(mesh.vertex(mesh.faces(f, 2)) - a);
}

/// The box around the vertices that faces use.
struct Box {
    Vec3 low, high;
};
Box bounding_box(const TriangleMesh& mesh);
/// Total area.
double surface_area(const TriangleMesh& mesh);
/// Unit normals at vertices: face normals weighted by the corner's angle. Zero where no face has area.
Points vertex_normals(const TriangleMesh& mesh);

}  // namespace varimap
