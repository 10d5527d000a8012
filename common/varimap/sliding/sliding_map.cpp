#include "varimap/sliding/sliding_map.h"

#include "varimap/core/index_set.h"
#include "varimap/mesh/unit_area.h"

namespace varimap {

namespace {

FaceData<TangentFrame> tangent_frames(const TriangleMesh& mesh) {
    FaceData<TangentFrame> frames(mesh.face_count());
    for (int f = 0; f < mesh.face_count(); ++f) {
        const Vec3 edge = mesh.vertex(mesh.faces(f, 1)) - mesh.vertex(mesh.faces(f, 0));
        frames[f].col(0) = edge.normalized();
        frames[f].col(1) = face_normal(mesh, f).normalized().cross(frames[f].col(0));
    }
    return frames;
}

}  // namespace

SlidingMap::SlidingMap(const PointMap& map, const TriangleMesh& source, const TriangleMesh& target)
    : source_(unit_area(source)),
      target_(unit_area(target)),
      normals_{vertex_normals(target_), target_.faces},
      rest_(rest_triangles(source_)),
      faces_of_vertex_(vertex_faces(source_)),
      longest_edge_(longest_edges(source_)),
      frames_(tangent_frames(target_)),
      walk_(target_),
      points_(int(map.size())),
      image_(points_.size(), Vec3::Zero()),
      normal_(points_.size(), Vec3::Zero()) {
    for (int v = 0; v < points_.size(); ++v)
        if (map[v].face >= 0) place(v, map[v]);
}

PointMap SlidingMap::points_of(const std::vector<int>& vertices) const {
    PointMap points;
    points.reserve(vertices.size());
    for (const int v : vertices) points.push_back(points_[v]);
    return points;
}

void SlidingMap::place(const std::vector<int>& vertices, const PointMap& points) {
    for (std::size_t i = 0; i < vertices.size(); ++i) place(vertices[i], points[i]);
}

void SlidingMap::restore(const PointMap& points) {
    for (int v = 0; v < points_.size(); ++v)
        if (has_image(v)) place(v, points[std::size_t(v)]);
}

std::vector<int> SlidingMap::faces_around(const std::vector<int>& vertices) const {
    std::vector<int> faces;
    for (const int v : vertices) {
        const auto star = faces_of_vertex_[v];
        faces.insert(faces.end(), star.begin(), star.end());
    }
    make_set(faces);
    return faces;
}

double area_of(const SlidingMap& map, const std::vector<int>& faces) {
    double sum = 0;
    for (const int f : faces) sum += map.rest(f).area;
    return sum;
}

double area_of(const SlidingMap& map, const FaceData<bool>& marked) {
    double sum = 0;
    for (int f = 0; f < marked.size(); ++f)
        if (marked[f]) sum += map.rest(f).area;
    return sum;
}

}  // namespace varimap
