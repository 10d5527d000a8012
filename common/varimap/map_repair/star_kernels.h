#pragma once

#include <cstddef>
#include <vector>

#include "varimap/geodesics/log_map.h"
#include "varimap/sliding/along_target.h"
#include "varimap/sliding/sliding_map.h"

namespace varimap {

/// Turns faces that are reversed along the target (along_target.h) upright, vertex by vertex. The kernel of a
/// vertex's star, as laid out around its image, are the places for it from which all faces around it are
/// upright: the vertex goes to the centre of the largest circle in there; where there is no such place,
/// where the worst face is the least wrong.
class StarKernels {
  public:
    /// Keeps references.
    StarKernels(SlidingMap& map, AlongTarget& along_target)
        : map_(map), along_target_(along_target), log_map_(map.target(), along_target.target_edges()) {}

    /// Visits the corners of these faces, and then what is around those that moved, for as long as faces get
    /// less wrong, 5 times at most. Where some stay wrong, all of `free` go to the centres of their kernels,
    /// which makes room, and it begins anew, 6 times at most, as long as all calls together have not visited
    /// more than 2000 of them: torn maps have no end of such faces. Moved are vertices of `free` (ascending;
    /// none on the source's boundary).
    void centre(const std::vector<int>& faces, const std::vector<int>& free);

  private:
    double wrong(int f);
    double wrong_around(int v);
    /// What a move is for: less that is wrong, or room for others where nothing gets more wrong.
    enum class Aim { upright, room };
    bool move_to_centre(int v, Aim aim);
    void turn_upright(std::vector<int> faces, const std::vector<int>& free);

    SlidingMap& map_;
    AlongTarget& along_target_;
    LogMap log_map_;
    std::ptrdiff_t visits_for_room_ = 0;
};

}  // namespace varimap
