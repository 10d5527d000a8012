#pragma once

#include <utility>
#include <vector>

#include "varimap/mesh/topology.h"
#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// Some faces of a mesh as a mesh of its own, in the order they have in the whole.
struct SubMesh {
    TriangleMesh mesh;
    std::vector<int> vertex, face;  ///< of the whole, per vertex and face of the part; ascending

    /// faces: ascending, none twice.
    SubMesh(const TriangleMesh& whole, std::vector<int> faces);
    /// A point of the whole on the part; face -1 where it lies on another face.
    SurfacePoint on_part(const SurfacePoint& point) const;
    SurfacePoint on_whole(const SurfacePoint& point) const {
        return {face[std::size_t(point.face)], point.barycentric};
    }
};

/// The boundary of a disc, once around with the faces to the left; empty if the mesh is no disc (connected,
/// genus 0, one boundary that touches itself nowhere).
std::vector<int> disc_boundary(const TriangleMesh& mesh);

/// Tutte's embedding of a disc: every vertex of the result, which lies in the plane z = 0, is a mean of its
/// neighbours with positive weights, and `boundary` (as disc_boundary gives it) has the positions of `rim`,
/// one per row. Positive throughout if these are the corners of a strictly convex polygon, counter-clockwise.
/// The weights are the mean-value ones of Floater (2003), made symmetric, and then made smaller where areas
/// have shrunk, and once more, so that areas become more even (Yoshizawa et al. 2004): with the first ones a
/// limb shrinks by exp(-2 pi length / girth). Up to three times more where a part would still be a point.
Points even_embedding(const TriangleMesh& disc, const std::vector<int>& boundary, const Points& rim);
/// The same onto the unit circle, which is divided as the lengths along the boundary are.
TriangleMesh circular_chart(const TriangleMesh& disc, const std::vector<int>& boundary);

/// Sets of faces of a mesh that become discs. Keeps a reference; holds scratch space for one thread.
class FaceSets {
  public:
    FaceSets(const TriangleMesh& mesh, SharedEdges edges)
        : mesh_(mesh), edges_(std::move(edges)), faces_(vertex_faces(mesh)), marks_(mesh.face_count(), 0) {}

    const Edges& edges() const { return *edges_; }
    /// The faces, and all that share a vertex with them, `count` times over; ascending.
    std::vector<int> widened(std::vector<int> faces, int count);
    /// The faces, and every part of the rest that holds one of `seeds` and has at most `most` faces;
    /// ascending.
    std::vector<int> enclosed(std::vector<int> faces, const std::vector<int>& seeds, int most);
    /// The faces, and every part of the rest of at most `most` faces that they cut off; ascending.
    std::vector<int> filled(std::vector<int> faces, int most);

  private:
    template <class Visit>
    void neighbours(int f, const Visit& visit) const {
        for (int k = 0; k < 3; ++k)
            for (const int half_edge : edges_->half_edges[edges_->of_half_edge[std::size_t(3 * f + k)]])
                if (half_edge / 3 != f) visit(half_edge / 3);
    }
    void mark(const std::vector<int>& faces, char value) {
        for (const int f : faces) marks_[f] = value;
    }

    const TriangleMesh& mesh_;
    SharedEdges edges_;
    Adjacency faces_;  ///< of vertices
    FaceData<char> marks_;
};

}  // namespace varimap
