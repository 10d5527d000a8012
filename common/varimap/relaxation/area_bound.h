#pragma once

#include <vector>

#include "varimap/sliding/sliding_map.h"

namespace varimap {

/// Keeps the areas of a map within the bound B of Sec. 3.4 where the plan has become a map: the faces around
/// a vertex are together to have an image of 1/B to B times their area. A continuation: around vertices whose
/// ratio lies outside, the faces' area weight (fold_energy.h) grows with each call of `press`, and what
/// relaxes the map after each call does the rest. Weights stay for as long as this lives, so that nothing
/// falls back; repairs that follow had better be without them.
class AreaBound {
  public:
    /// Of such a bound maps relax so far out that there is no way back in the end: it is kept from the start,
    /// and with more weight.
    static bool is_tight(double bound) { return bound < 1.5; }

    /// Keeps a reference to the map. `exempt`: vertices that need not keep it, as landmarks, whose images are
    /// fixed.
    AreaBound(SlidingMap& map, double bound, VertexData<bool> exempt);
    ~AreaBound();
    AreaBound(const AreaBound&) = delete;
    AreaBound& operator=(const AreaBound&) = delete;

    /// Raises the weights; returns the corners of the faces that got more, ascending: none where all keep the
    /// bound. Reversed faces get none, whose energy would outweigh all others'.
    std::vector<int> press();
    /// The same where no vertex has moved since but some of `moved`, which hold all that were returned then
    /// or at least those that can move.
    std::vector<int> press_again(const std::vector<int>& moved);

  private:
    std::vector<int> press(const std::vector<int>& vertices);
    bool is_kept(int v) const;

    SlidingMap& map_;
    double bound_, first_weight_;
    VertexData<bool> exempt_;
};

}  // namespace varimap
