#pragma once

#include <vector>

#include "varimap/core/linear_algebra.h"
#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// How well patches of a surface can be laid onto their images: of all rotations R of a patch, with points x
/// of normals n and images y of normals m, relative to the patch's and the image's centres and mean square
/// radii r and s,
///     max over R of mean(y . R x / (r s) + m . R n) / 2,
/// 1 at best, mean of the patches. Limbs may bend between patches; which side of a limb is which, and what
/// belongs beside what, shows within them.
class PatchAlignment {
  public:
    /// Of vertices: `mass`, and `normals`, outward.
    PatchAlignment(Points vertices, Points normals, Eigen::VectorXd mass)
        : vertices_(std::move(vertices)), normals_(std::move(normals)), mass_(std::move(mass)) {}

    /// Adds patches of what is nearer than the radius to each centre. `distance`: centres x vertices.
    /// `weight`: of each centre's patch.
    void add_patches(const RowMatrix& distance, double radius, const Eigen::VectorXd& weight);

    /// `images` of the vertices, and the outward normals there. `opposed`: the surfaces are of opposite
    /// handedness, so that R are reflections.
    double operator()(const Points& images, const Points& image_normals, bool opposed) const;

  private:
    struct Patch {
        std::vector<int> vertices;
        double weight;
    };
    double aligned(const Patch& patch, const Points& images, const Points& image_normals, bool opposed) const;

    Points vertices_, normals_;
    Eigen::VectorXd mass_;
    std::vector<Patch> patches_;
};

}  // namespace varimap
