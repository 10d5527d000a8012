#pragma once

#include <vector>

#include "varimap/core/indexed.h"
#include "varimap/surface/input_locator.h"
#include "varimap/surface/surface.h"
#include "varimap/untangling/untangling_options.h"

namespace varimap {

/// One direction of a map on its way from the vertices of the source's mesh to those of its input, with
/// images on the target's input: linear on the mesh's faces, closest points that face the same way there.
///
/// From a coarse mesh the way leads over levels between: the mesh is subdivided, and the images of its
/// vertices are relaxed and unfolded there, until it is about as fine as the input. Straight from the coarse
/// mesh, faces as large as a toe cut through the target, and .2 to .3% of the area comes out reversed; the
/// levels leave about a fifth of that, and folds of few faces each. Of large inputs, what stays folded on the
/// last level but one is mapped anew there (chart_repair.h), where it has some tenth of the faces it would
/// have on the input. (With no level between there are few such faces on the input: 1 of 40,000.)
class Prolongation {
  public:
    /// `images`: of the vertices of source.mesh, on target.mesh. Keeps references to the surfaces.
    Prolongation(const PointMap& images, const Surface& source, const Surface& target);

    /// Takes the levels between. What stays: pinned vertices of source.mesh, and the corners of faces that
    /// hold one of `landmarks`, points of source.mesh.
    /// Of `options`, area_weight, fold_sweeps and align_normals count.
    void relax_between(const VertexData<bool>& pinned, std::vector<SurfacePoint> landmarks,
                       const UntanglingOptions& options);
    /// Per vertex of source.input; nowhere for those that no face uses.
    PointMap on_input() const;

  private:
    bool is_as_fine_as(double share_of_input) const;
    /// Of points of the level; nowhere where these are.
    PointMap images_of(const PointMap& points) const;
    void refine();
    void relax(const VertexData<bool>& pinned, const std::vector<SurfacePoint>& landmarks,
               const UntanglingOptions& options, bool folds_anew);

    InputLocator locate_;
    TriangleMesh target_;  ///< the target's input
    Points normals_;       ///< of it, at its vertices
    TriangleMesh level_;   ///< the source's mesh, subdivided
    PointMap images_;      ///< of its vertices
    PointMap places_;      ///< of the source's input vertices, on it
    int input_vertices_;   ///< of which faces use so many
};

}  // namespace varimap
