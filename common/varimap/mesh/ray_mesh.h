#pragma once

#include <memory>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

class EmbreeScene;

/// A mesh to be hit by rays (Embree, single precision; coordinates should be of order 1). Thread-safe once
/// built.
class RayMesh {
  public:
    explicit RayMesh(const TriangleMesh& mesh);
    ~RayMesh();
    RayMesh(RayMesh&&) noexcept;

    /// The first point on the ray; face -1 for none.
    SurfacePoint first_hit(const Vec3& origin, const Vec3& direction) const;
    /// Whether anything is hit closer than `reach` times the direction's length.
    bool is_blocked(const Vec3& origin, const Vec3& direction, double reach) const;

  private:
    std::unique_ptr<const EmbreeScene> scene_;
};

}  // namespace varimap
