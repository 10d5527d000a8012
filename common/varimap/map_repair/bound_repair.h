#pragma once

#include <vector>

#include "varimap/relaxation/area_bound.h"
#include "varimap/sliding/sliding_map.h"

namespace varimap {

/// Brings a map back into the area bound (area_bound.h) where the repair of its faults (fault_repair.h) has
/// taken it out of it: what is mapped anew in charts knows nothing of the bound. Sweeps around vertices that
/// do not keep it make room for them, without new faults (fault_guard.h).
class BoundRepair {
  public:
    /// Keeps a reference. `exempt`: vertices that need not keep the bound; `held`: those that stay.
    BoundRepair(SlidingMap& map, double bound, VertexData<bool> exempt, VertexData<bool> held);

    void operator()(const FoldEnergy& energy);

  private:
    /// Those of these vertices, and of two rings around them, that may move; ascending.
    std::vector<int> free_around(const std::vector<int>& vertices) const;
    void sweep(const std::vector<int>& free, const FoldEnergy& energy);

    SlidingMap& map_;
    AreaBound bound_;
    const int most_looks_;
    const VertexData<bool> held_;
};

}  // namespace varimap
