#pragma once

#include <functional>
#include <string>
#include <vector>

#include "stages/render/colour.h"
#include "varimap/mesh/ray_mesh.h"
#include "varimap/quality/image_mesh.h"

namespace varimap {

/// A surface ready to be seen: where rays hit it, how it is lit, and what colour its points have.
class Figure {
  public:
    using Paint = std::function<Colour(const SurfacePoint&)>;

    /// The mesh must have unit area. `flagged` triangles get the warning colour.
    Figure(TriangleMesh mesh, Paint paint, std::vector<bool> flagged);

    const TriangleMesh& mesh() const { return mesh_; }
    const RayMesh& rays() const { return rays_; }
    /// Light that leaves a point towards a viewer; `view` gives its rows right, up and towards the viewer.
    Colour shade(const SurfacePoint& point, const Eigen::Matrix3d& view) const;

  private:
    TriangleMesh mesh_;
    Paint paint_;
    std::vector<bool> flagged_;
    RayMesh rays_;
    Points normals_;
    std::vector<double> openness_;
};

/// Per triangle of the image mesh's source: whether its image is reversed (as quality.h counts flips); where
/// the map reverses orientation on purpose (`mirror`), whether it is not.
std::vector<bool> reversed_faces(const ImageMesh& images, bool mirror);
/// How many there are on both surfaces, in words.
std::string reversed_text(const std::vector<bool>& source, const std::vector<bool>& target);

}  // namespace varimap
