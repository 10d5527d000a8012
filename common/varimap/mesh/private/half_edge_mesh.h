#pragma once

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "varimap/core/error.h"
#include "varimap/mesh/triangle_mesh.h"

/// OpenMesh's half-edges, for what changes the connectivity of a mesh. For the sources of this room.
namespace varimap {

struct HalfEdgeTraits : OpenMesh::DefaultTraitsDouble {
    VertexAttributes(OpenMesh::Attributes::Status);
    EdgeAttributes(OpenMesh::Attributes::Status);
    FaceAttributes(OpenMesh::Attributes::Status);
    HalfedgeAttributes(OpenMesh::Attributes::Status);
};
using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<HalfEdgeTraits>;

/// The same vertices and faces by the same numbers, in a mesh of OpenMesh. Throws an internal Error unless
/// the mesh is manifold.
template <class Mesh = HalfEdgeMesh>
Mesh half_edges(const TriangleMesh& mesh) {
    omerr().disable();  // a refused face is reported below
    Mesh result;
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

inline Vec3 point(const HalfEdgeMesh& mesh, OpenMesh::VertexHandle v) {
    return Vec3(mesh.point(v).data());
}

}  // namespace varimap
