#include "varimap/quality/image_mesh.h"

#include "varimap/mesh/face_geometry.h"
#include "varimap/mesh/unit_area.h"

namespace varimap {

ImageMesh::ImageMesh(const PointMap& map, const TriangleMesh& from, const TriangleMesh& to)
    : source(unit_area(from)),
      target(unit_area(to)),
      image{Points::Zero(from.vertex_count(), 3), from.faces},
      normals(Points::Zero(from.vertex_count(), 3)),
      has_image_(from.vertex_count()) {
    const TriangleMesh normals_of_target{vertex_normals(target), target.faces};
    for (int v = 0; v < from.vertex_count(); ++v) {
        const SurfacePoint& point = map[v];
        if (point.face < 0) continue;
        has_image_[v] = true;
        image.vertices.row(v) = position(target, point).transpose();
        normals.row(v) = position(normals_of_target, point).transpose();
    }
}

bool ImageMesh::is_mapped(int f) const {
    const auto corners = source.faces.row(f);
    return has_image_[corners[0]] && has_image_[corners[1]] && has_image_[corners[2]];
}

double ImageMesh::facing(int f) const {
    const auto corners = source.faces.row(f);
    const Vec3 m = (normals.row(corners[0]) + normals.row(corners[1]) + normals.row(corners[2])).transpose();
    return face_normal(image, f).dot(m);
}

}  // namespace varimap
