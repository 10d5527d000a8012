#pragma once

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
    /// Of the loops that correspond as the map is now; keeps a reference to it.
    explicit BoundaryAgreement(const SlidingMap& map);
    /// Each vertex on one of these loops, of length l (half of its two edges), draws its image to the closest
    /// point of the other loop, as that is now, with the weight l * weight.
    std::vector<SoftConstraint> constraints(double weight) const;

  private:
    /// A vertex of the source's boundary and the target's loop that it goes to.
    struct Drawn {
        SurfacePoint vertex;
        double length;
        int loop;
    };

    const SlidingMap& map_;
    Boundary target_;
    std::vector<Drawn> drawn_;
};

}  // namespace varimap
