#include "stages/transfer/same_mesh.h"

#include <fmt/format.h>

#include "varimap/core/error.h"

namespace varimap {

namespace {

constexpr double same_place = 1e-3;  ///< of vertices of one mesh in two files, relative to its extent

}  // namespace

bool same_faces(const TriangleMesh& a, const TriangleMesh& b) {
    return a.vertex_count() == b.vertex_count() && a.face_count() == b.face_count() && a.faces == b.faces;
}

bool same_vertices(const TriangleMesh& a, const TriangleMesh& b) {
    if (a.vertex_count() != b.vertex_count()) return false;
    const Box box = bounding_box(b);  // the other may be a cloud
    return (a.vertices - b.vertices).rowwise().norm().maxCoeff() <= same_place * (box.high - box.low).norm();
}

void require_same_mesh(bool same, const std::string& path, const TriangleMesh& found,
                       const std::string& mesh_file, const TriangleMesh& mesh) {
    if (same) return;
    if (found.vertex_count() == mesh.vertex_count() && found.face_count() == mesh.face_count())
        throw InputError(
            fmt::format("{}: is not the mesh {} of the map: it has as many vertices and triangles, "
                        "but in another order, or other places and polygons",
                        path, mesh_file));
    throw InputError(fmt::format(
        "{}: is not the mesh {} of the map in the same order: {} vertices and {} triangles, there {} and {}",
        path, mesh_file, found.vertex_count(), found.face_count(), mesh.vertex_count(), mesh.face_count()));
}

}  // namespace varimap
