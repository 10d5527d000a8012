#pragma once

#include <vector>

#include "common/mesh/triangle_mesh.h"

namespace varimap::shapes {

/// A capsule that tapers from radius ra at a to rb at b.
struct Limb {
    Vec3 a, b;
    double ra, rb;
    /// From its surface; negative inside.
    double distance(const Vec3& p) const;
};

/// Distance from the union of the limbs, smooth where they meet; negative inside.
double smooth_distance(const std::vector<Limb>& limbs, const Vec3& p);

}  // namespace varimap::shapes
