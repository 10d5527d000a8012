#pragma once

#include <vector>

#include "varimap/mesh/log_map.h"
#include "varimap/relaxation/laid_out.h"
#include "varimap/relaxation/sliding_map.h"

namespace varimap {

/// Turns faces that are reversed along the target (laid_out.h) upright, vertex by vertex. The kernel of a
/// vertex's star, as laid out around its image, are the places for it from which all faces around it are
/// upright: the vertex goes to the centre of the largest circle in there; where there is no such place,
/// where the worst face is the least wrong.
class StarKernels {
  public:
    /// Keeps references.
    StarKernels(SlidingMap& map, const LaidOut& laid_out)
        : map_(map), laid_out_(laid_out), log_map_(map.target()) {}

    /// Visits the corners of these faces, and then what is around those that moved, for as long as faces get
    /// less wrong, 5 times at most. Moved are vertices of `free` (ascending; none on the source's boundary).
    void centre(std::vector<int> faces, const std::vector<int>& free);

  private:
    double wrong(int f) const;
    double wrong_around(int v) const;
    bool move_to_centre(int v);

    SlidingMap& map_;
    const LaidOut& laid_out_;
    LogMap log_map_;
};

}  // namespace varimap
