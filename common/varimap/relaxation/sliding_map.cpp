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
      points_(map.size()),
      image_(map.size(), Vec3::Zero()),
      normal_(map.size(), Vec3::Zero()) {
    for (int v = 0; v < int(map.size()); ++v)
        if (map[std::size_t(v)].face >= 0) place(v, map[std::size_t(v)]);
}

void SlidingMap::place(int v, const SurfacePoint& point) {
    points_[std::size_t(v)] = point;
    image_[std::size_t(v)] = position(target_, point);
    normal_[std::size_t(v)] = position(normals_, point);
}

Vec3 SlidingMap::mean_normal(int f) const {
    return (normal_[std::size_t(source_.faces(f, 0))] + normal_[std::size_t(source_.faces(f, 1))] +
            normal_[std::size_t(source_.faces(f, 2))])
        .normalized();
}

ImageTriangle SlidingMap::image_triangle(int f) const {
    return {rest(f), image(source_.faces(f, 0)), image(source_.faces(f, 1)), image(source_.faces(f, 2)),
            mean_normal(f)};
}

Eigen::Matrix<double, 3, 2> SlidingMap::tangents(int v) const {
    const int face = points_[std::size_t(v)].face;
    const Vec3 edge = target_.vertex(target_.faces(face, 1)) - target_.vertex(target_.faces(face, 0));
    Eigen::Matrix<double, 3, 2> frame;
    frame.col(0) = edge.normalized();
    frame.col(1) = face_normal(target_, face).normalized().cross(frame.col(0));
    return frame;
}

}  // namespace varimap
