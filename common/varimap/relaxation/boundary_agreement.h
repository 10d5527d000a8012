#pragma once

#include <array>
#include <vector>

#include "varimap/mesh/boundary.h"
#include "varimap/relaxation/soft_constraints.h"

namespace varimap {

/// What takes boundaries to boundaries, as a bijection does. Nothing else in the energy asks for it: both
/// directions of a map between open surfaces may leave a margin of the other out, and slide by as much.
///
/// A loop of the source and one of the target correspond where either is the other's nearest, by the mean
/// distance of the images of the source's vertices; if that is less than the radius of a circle of the
/// loop's length, so that they overlap; and if neither is more than twice as long as the other: rims of
/// small holes that only one surface has are left alone.
class BoundaryAgreement {
  public:
    /// Keeps a reference to the map. No loops correspond until they are matched.
    explicit BoundaryAgreement(const SlidingMap& map);
    /// Finds the loops that correspond as the map is now.
    void match();
    /// Each vertex on one of these loops, of length l (half of its two edges), draws its image to the closest
    /// point of the other loop, as that is now, with the weight l * weight.
    std::vector<SoftConstraint> constraints(double weight) const;

  private:
    /// Of the source's boundary.
    struct Vertex {
        int vertex, loop;
        double length;  ///< half of its two edges
        SurfacePoint point;
    };
    static std::vector<Vertex> vertices_of(const TriangleMesh& mesh, const Boundary& boundary);
    Eigen::MatrixXd mean_distances() const;

    const SlidingMap& map_;
    Boundary source_, target_;
    std::vector<std::vector<std::array<int, 2>>> target_loops_;  ///< their edges
    std::vector<Vertex> vertices_;                               ///< ascending
    std::vector<int> partner_;  ///< per loop of the source that of the target, or -1
};

}  // namespace varimap
