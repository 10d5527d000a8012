#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// Closest points on a mesh (Embree bounding volume hierarchy, distances in double precision).
/// Thread-safe once built; holds a copy of what it needs, in an order of its own that keeps near faces
/// together.
class ClosestPoint {
  public:
    explicit ClosestPoint(const TriangleMesh& mesh);
    ~ClosestPoint();
    ClosestPoint(ClosestPoint&&) noexcept;

    struct Hit {
        SurfacePoint point;
        double squared_distance;
    };
    /// The closest point; among equals, the lowest face. The query must be finite; each coordinate beyond 1e6
    /// times the mesh's size counts as that far. `guess`: a face that may be near, which saves time.
    Hit operator()(const Vec3& query, int guess = -1) const;
    /// The closest point whose unit face normal has a positive product with `normal`, so that the other side
    /// of a thin part does not attract; where no such face exists, the closest point of all.
    Hit operator()(const Vec3& query, const Vec3& normal, int guess = -1) const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// The same, built when it is first asked. Thread-safe; holds a copy of `make`, which makes the mesh.
class ClosestPointOnDemand {
  public:
    explicit ClosestPointOnDemand(std::function<TriangleMesh()> make) : make_(std::move(make)) {}
    const ClosestPoint& operator*() const {
        std::call_once(once_, [this] { closest_.emplace(make_()); });
        return *closest_;
    }

  private:
    std::function<TriangleMesh()> make_;
    mutable std::once_flag once_;
    mutable std::optional<ClosestPoint> closest_;
};

/// Closest point of a segment as coordinate along ab, in [0, 1].
double closest_on_segment(const Vec3& query, const Vec3& a, const Vec3& b);
/// Closest point of one triangle as barycentric coordinates.
Vec3 closest_barycentric(const Vec3& query, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace varimap
