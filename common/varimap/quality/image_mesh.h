#pragma once

#include "varimap/core/indexed.h"
#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

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
