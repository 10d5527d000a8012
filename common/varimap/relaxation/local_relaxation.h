#pragma once

#include <cstdint>
#include <vector>

#include "varimap/sliding/branch_points.h"
#include "varimap/sliding/sliding_map.h"

namespace varimap {

/// The mapped faces around a vertex, with what of them does not depend on the vertex's own image: gathered
/// once for all the places that are tried for it.
class Star {
  public:
    /// Gradient, Hessian and value of the faces' energy, in the vertex's tangent plane.
    struct Quadratic {
        double value = 0;
        Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
        Eigen::Matrix2d hessian = Eigen::Matrix2d::Zero();
        bool has_reversed = false;
    };

    void gather(const SlidingMap& map, int v);
    /// Of the vertex at that image, with the target's normal (not of unit length) there.
    Quadratic quadratic(const Vec3& image, const Vec3& normal, const TangentFrame& frame,
                        const FoldEnergy& energy) const;
    /// Once it gets to `limit`, faces that follow are left out.
    double energy(const Vec3& image, const Vec3& normal, const FoldEnergy& energy, double limit) const;
    bool has_reversed(const Vec3& image, const Vec3& normal) const;
    /// Mean of the other corners' images, each as often as it occurs; false where there are none.
    bool mean_of_others(Vec3& mean) const;

  private:
    struct Face {
        RestTriangle rest;  ///< beginning at the vertex
        Vec3 y, z, normal;  ///< images of the corners after it, sum of the target's normals there
        ImageTriangle image(const Vec3& x, const Vec3& n) const { return {rest, x, y, z, n + normal}; }
    };
    std::vector<Face> faces_;
};

/// Block-coordinate descent of the fold energy: vertices in random order (fixed seed), each by one Newton
/// step in the tangent plane of its image with up to 7 backtracks, every trial a straightest walk judged by
/// the true energy of the vertex's faces, which therefore never grows. Where a face is reversed, a place
/// that makes a branch point is refused.
class LocalRelaxation {
  public:
    LocalRelaxation(SlidingMap& map, std::uint32_t seed) : map_(map), state_(seed), guard_(map) {}

    /// One visit of every vertex of `vertices` (none may be a landmark or without an image); reorders them.
    void sweep(std::vector<int>& vertices, const FoldEnergy& energy);
    /// One visit of those that are awake. Each falls asleep, and wakes itself and all it shares a face with
    /// if it moves noticeably. Those with a reversed face also try the mean of their neighbours' images, and
    /// walks towards it.
    void sweep_awake(std::vector<int>& vertices, const FoldEnergy& energy, VertexData<bool>& awake);

  private:
    void shuffle(std::vector<int>& vertices);
    void wake_neighbours(int v, VertexData<bool>& awake) const;
    void newton_step(int v, const FoldEnergy& energy);
    void leap_to_mean(int v, const FoldEnergy& energy);
    bool try_walk(int v, const SurfacePoint& from, const Vec3& step, double before, const FoldEnergy& energy);

    SlidingMap& map_;
    std::uint32_t state_;
    Star star_;  ///< of the vertex under visit
    BranchGuard guard_;
};

}  // namespace varimap
