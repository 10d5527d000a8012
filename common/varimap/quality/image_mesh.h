#pragma once

#include "varimap/core/indexed.h"
#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// The mesh moved and scaled to unit area, its bounding box centred at the origin.
TriangleMesh unit_area(const TriangleMesh& mesh);

/// Whether a triangle has no area beyond rounding: twice its area is at most 1e-10 of its longest edge
/// squared (or the edge is no longer than rounding leaves it; coordinates are of order 1).
bool is_degenerate(const TriangleMesh& mesh, int f);

/// A map with both meshes at unit area, and the source's triangles spanned between the images of their
/// corners.
struct ImageMesh {
    TriangleMesh source, target;  ///< at unit area
    TriangleMesh image;  ///< the source's faces, its vertices at their images; without an image, at 0
    Points normals;      ///< per source vertex: the target's interpolated normal at the image

    ImageMesh(const PointMap& map, const TriangleMesh& source, const TriangleMesh& target);

    /// Whether all corners of a face have an image.
    bool is_mapped(int f) const;
    /// n . m with n the image triangle's normal (twice its area) and m the sum of the target's normals at its
    /// corners: negative where the map reverses orientation.
    double facing(int f) const;

  private:
    VertexData<bool> has_image_;
};

}  // namespace varimap
