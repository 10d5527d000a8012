#include "varimap/mesh/private/half_edge_mesh.h"

#include "varimap/core/error.h"

namespace varimap {

HalfEdgeMesh half_edges(const TriangleMesh& mesh) {
    omerr().disable();  // a refused face is reported below
    HalfEdgeMesh result;
    result.reserve(std::size_t(mesh.vertex_count()), std::size_t(mesh.vertex_count() + mesh.face_count()),
                   std::size_t(mesh.face_count()));
    for (int v = 0; v < mesh.vertex_count(); ++v)
        result.add_vertex(OpenMesh::Vec3d(mesh.vertices.row(v).data()));
    for (int f = 0; f < mesh.face_count(); ++f) {
        const auto vertex = [&](int c) { return result.vertex_handle(unsigned(mesh.faces(f, c))); };
        if (!result.add_face(vertex(0), vertex(1), vertex(2)).is_valid())
            throw Error(ExitCode::internal, "connectivity can be changed of manifold meshes alone");
    }
    return result;
}

}  // namespace varimap
