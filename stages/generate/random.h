#pragma once

#include <Eigen/Geometry>
#include <random>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap::shapes {

/// Random numbers that are the same on every platform.
class Random {
  public:
    explicit Random(unsigned seed) : generator_(seed) {}
    double between(double low, double high) { return low + (high - low) * (generator_() / 4294967296.0); }
    /// A unit vector, uniformly.
    Vec3 direction();
    Eigen::Matrix3d rotation();

  private:
    std::mt19937 generator_;
};

}  // namespace varimap::shapes
