#pragma once

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

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

/// The same vertices and faces by the same numbers. Throws an internal Error unless the mesh is manifold.
HalfEdgeMesh half_edges(const TriangleMesh& mesh);

inline Vec3 point(const HalfEdgeMesh& mesh, OpenMesh::VertexHandle v) {
    return Vec3(mesh.point(v).data());
}

}  // namespace varimap
