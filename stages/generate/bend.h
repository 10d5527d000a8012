#pragma once

#include "varimap/mesh/triangle_mesh.h"

namespace varimap::shapes {

/// A smooth invertible deformation of space, in closed form both ways: what lies beyond `start` along `axis`
/// is bent towards `direction` along an arc of that length and angle (radians), rigidly beyond the arc; the
/// rest stays. `axis` and `direction` are orthogonal unit vectors through `origin`; points on the arc need (p
/// - origin) . direction < length / angle.
struct Bend {
    Vec3 origin, axis, direction;
    double start, length, angle;
    Vec3 octant = Vec3::Zero();  ///< signs: only points with these signs of their coordinates move; 0: any
    Vec3 forward(const Vec3& p) const;
    Vec3 inverse(const Vec3& p) const;

  private:
    bool applies(const Vec3& p) const;
};

}  // namespace varimap::shapes
