#pragma once

#include "varimap/landmarks/vertex_list.h"
#include "varimap/surface/surface.h"

namespace varimap {

/// The vertices that stand for landmarks on the surfaces' meshes: those at them, or else corners of the faces
/// they lie on or, of many close together, vertices around it, a different one for each. Throws InputError
/// for those no face uses, for two that became one, and where vertices are too few.
VertexPairs<MeshVertex> to_mesh_vertices(const VertexPairs<InputVertex>& landmarks, const Surface& A,
                                         const Surface& B);
/// Landmarks as points of the inputs, where they lie between vertices of the preprocessed or coarsened
/// meshes; else none.
PointPairs landmark_points(const Landmarks& landmarks, const Surface& A, const Surface& B);

/// Landmarks, of a hundred at most all over the list, each of which finds a vertex of its own on both meshes,
/// and these vertices.
struct HeldApart {
    Landmarks landmarks;
    VertexPairs<MeshVertex> vertices;
};
HeldApart held_apart(const Landmarks& landmarks, const Surface& A, const Surface& B);

}  // namespace varimap
