#include "varimap/mesh_repair/file_link.h"

#include <fmt/format.h>

#include <utility>

#include "varimap/core/index_set.h"
#include "varimap/mesh/closest_point.h"

namespace varimap {
namespace {

/// Closest points on those faces of a mesh that are its file's.
class FileFaces {
  public:
    FileFaces(const TriangleMesh& mesh, const FileLink& link)
        : closest_([&mesh, this] {
              return TriangleMesh{mesh.vertices, mesh.faces(number_, Eigen::all)};
          }) {
        for (int f = 0; f < mesh.face_count(); ++f)
            if (link.face[std::size_t(f)] >= 0) number_.push_back(f);
    }
    SurfacePoint operator()(const Vec3& x) const {
        SurfacePoint point = (*closest_)(x).point;
        point.face = number_[std::size_t(point.face)];
        return point;
    }

  private:
    std::vector<int> number_;
    ClosestPointOnDemand closest_;
};

/// Per face of the file: the mesh's, -1 where it was dropped.
std::vector<int> faces_of_mesh(const FileLink& link) {
    std::vector<int> result(std::size_t(link.file.face_count()), -1);
    for (std::size_t f = 0; f < link.face.size(); ++f)
        if (link.face[f] >= 0) result[std::size_t(link.face[f])] = int(f);
    return result;
}

/// Rows by another numbering; -1: nowhere.
PointMap by_rows(const PointMap& map, const std::vector<int>& rows) {
    PointMap result;
    for (const int row : rows) result.push_back(row < 0 ? SurfacePoint{} : map[std::size_t(row)]);
    return result;
}

void turn_where(bool turned, SurfacePoint& point) {
    if (turned) std::swap(point.barycentric[1], point.barycentric[2]);
}

}  // namespace

PointMap to_file(const PointMap& map, const FileLink& source, const FileLink& target,
                 const TriangleMesh& target_mesh) {
    PointMap result = source.is_identity() ? map : by_rows(map, source.vertex);
    if (target.is_identity()) return result;
    const FileFaces file_faces(target_mesh, target);
    for (SurfacePoint& point : result) {
        if (point.face < 0) continue;
        if (target.face[std::size_t(point.face)] < 0) point = file_faces(position(target_mesh, point));
        turn_where(target.turned[std::size_t(point.face)], point);
        point.face = target.face[std::size_t(point.face)];
    }
    return result;
}

PointMap from_file(const PointMap& map, const FileLink& source, const FileLink& target) {
    PointMap result = source.is_identity() ? map : by_rows(map, source.origin);
    if (target.is_identity()) return result;
    const std::vector<int> face = faces_of_mesh(target);
    for (SurfacePoint& point : result) {
        if (point.face >= 0) point.face = face[std::size_t(point.face)];
        if (point.face < 0)
            point = {};
        else
            turn_where(target.turned[std::size_t(point.face)], point);
    }
    return result;
}

const char* reason_without_face(VertexFate fate) {
    switch (fate) {
        case VertexFate::unused:
            return "no face of the file names it";
        case VertexFate::not_finite:
            return "a coordinate of it is not a number";
        case VertexFate::component_dropped:
            return "its component is left out (varimap help meshes)";
        case VertexFate::outside_part:
            return "it lies outside of the part that is mapped";
        default:
            return "its faces were dropped by the repair (varimap help meshes)";
    }
}

FileLink link_to_itself(const TriangleMesh& mesh) {
    FileLink link{mesh, all_indices(mesh.vertex_count()), {}, {}, all_indices(mesh.face_count()), {}};
    link.origin = link.vertex;
    link.fate.assign(link.vertex.size(), VertexFate::unused);
    for (const int v : mesh.faces.reshaped()) link.fate[std::size_t(v)] = VertexFate::kept;
    link.turned.assign(link.face.size(), 0);
    return link;
}

TriangleMesh in_numbers_of_file(const TriangleMesh& mesh, const FileLink& link) {
    if (link.is_identity()) return mesh;
    TriangleMesh result = link.file;
    result.faces = mesh.faces.unaryExpr([&](int v) { return link.origin[std::size_t(v)]; });
    for (int f = 0; f < mesh.face_count(); ++f)
        if (const int face = link.face[std::size_t(f)]; face >= 0) {
            // A corner that was welded has a number of its own in the file.
            const auto own = link.file.faces.row(face);
            for (int c = 0; c < 3; ++c)
                for (int k = 0; k < 3; ++k)
                    if (link.vertex[std::size_t(own[k])] == mesh.faces(f, c)) result.faces(f, c) = own[k];
        }
    return result;
}

int number_in_file(int vertex, const FileLink& link) {
    return link.is_identity() ? vertex : link.origin[std::size_t(vertex)];
}

std::string face_in_words(int face, const FileLink& link) {
    const int number = link.is_identity() ? face : link.face[std::size_t(face)];
    return number < 0 ? "a face that a repair added" : fmt::format("face {}", number);
}

}  // namespace varimap
