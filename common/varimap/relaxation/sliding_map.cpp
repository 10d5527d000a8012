#include "varimap/relaxation/sliding_map.h"

#include "varimap/quality/image_mesh.h"

namespace varimap {

SlidingMap::SlidingMap(const PointMap& map, const TriangleMesh& source, const TriangleMesh& target)
    : source_(unit_area(source)),
      target_(unit_area(target)),
      normals_{vertex_normals(target_), target_.faces},
      rest_(rest_triangles(source_)),
      faces_of_vertex_(vertex_faces(source_)),
      walk_(target_),
      points_(int(map.size())),
      image_(points_.size(), Vec3::Zero()),
      normal_(points_.size(), Vec3::Zero()) {
    for (int v = 0; v < points_.size(); ++v)
        if (map[v].face >= 0) place(v, map[v]);
}

void SlidingMap::place(int v, const SurfacePoint& point) {
    points_[v] = point;
    image_[v] = position(target_, point);
    normal_[v] = position(normals_, point);
}

Vec3 SlidingMap::mean_normal(int f) const {
    return (normal_[source_.faces(f, 0)] + normal_[source_.faces(f, 1)] + normal_[source_.faces(f, 2)])
        .normalized();
}

ImageTriangle SlidingMap::image_triangle(int f) const {
    return {rest(f), image(source_.faces(f, 0)), image(source_.faces(f, 1)), image(source_.faces(f, 2)),
            mean_normal(f)};
}

TangentFrame SlidingMap::tangents(int v) const {
    const int face = points_[v].face;
    const Vec3 edge = target_.vertex(target_.faces(face, 1)) - target_.vertex(target_.faces(face, 0));
    TangentFrame frame;
    frame.col(0) = edge.normalized();
    frame.col(1) = face_normal(target_, face).normalized().cross(frame.col(0));
    return frame;
}

}  // namespace varimap
