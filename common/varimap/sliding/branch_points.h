#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "varimap/sliding/sliding_map.h"

namespace varimap {

/// How many times the images of the faces around a vertex go around its image, as seen along the target's
/// normals there: 1 for a map that is one to one, 2 at a branch point, where two sheets of the map hang
/// together though no face need be reversed. Meaningless, but no more, on a boundary; faces without an image
/// are left out. Looks at straight faces: along_target.h is slower and sure.
int winding_number(const SlidingMap& map, int v);

/// Those of `vertices` where the map goes around twice or more.
std::vector<int> branch_points(const SlidingMap& map, const std::vector<int>& vertices);

/// Keeps moves of single vertices from making branch points: a vertex that crosses the far side of its star
/// while a face turns upright can wind its star, or a neighbour's, around twice, and no sliding undoes that.
class BranchGuard {
  public:
    explicit BranchGuard(SlidingMap& map) : map_(map) {}

    /// What is asked from now on is about this vertex, and compared with where it is.
    void watch(int v);
    /// Nothing is compared from now on.
    void rest() { watched_.clear(); }
    /// Whether there are no more branch points around the vertex, where it is, than there were.
    bool allows();

  private:
    std::size_t count() const { return branch_points(map_, watched_).size(); }

    SlidingMap& map_;
    std::vector<int> watched_;  ///< the vertex and its neighbours
    int vertex_ = -1;
    SurfacePoint start_;               ///< where it was
    std::optional<std::size_t> most_;  ///< branch points then, once that was asked
};

}  // namespace varimap
