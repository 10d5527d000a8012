#pragma once

#include <cstdint>
#include <vector>

#include "varimap/relaxation/sliding_map.h"

namespace varimap {

/// Block-coordinate descent of the fold energy: vertices in random order (fixed seed), each by one Newton
/// step in the tangent plane of its image with up to 7 backtracks, every trial a straightest walk judged by
/// the true energy of the vertex's faces, which therefore never grows.
class LocalRelaxation {
  public:
    LocalRelaxation(SlidingMap& map, std::uint32_t seed) : map_(map), state_(seed) {}

    /// One visit of every vertex of `vertices` (none may be a landmark or without an image); reorders them.
    /// With `leap`, vertices with a reversed face also try the mean of their neighbours' images, and walks
    /// towards it.
    void sweep(std::vector<int>& vertices, const FoldEnergy& energy, bool leap);

  private:
    void shuffle(std::vector<int>& vertices);
    void newton_step(int v, const FoldEnergy& energy);
    void leap_to_mean(int v, const FoldEnergy& energy);
    bool try_walk(int v, const Vec3& step, double before, const FoldEnergy& energy);
    bool has_reversed_face(int v) const;

    SlidingMap& map_;
    std::uint32_t state_;
};

}  // namespace varimap
