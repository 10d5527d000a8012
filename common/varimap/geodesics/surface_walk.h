#pragma once

#include <vector>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// Straightest walks on a triangle mesh: straight inside a face, and straight across an edge once the two
/// faces beside it are unfolded into one plane. At a boundary the walk goes on along the boundary.
/// Keeps a reference to the mesh. Thread-safe.
class SurfaceWalk {
  public:
    explicit SurfaceWalk(const TriangleMesh& mesh);

    /// Where the walk of length |step| from `start` ends; `step` lies in the plane of the start's face (what
    /// does not is dropped). A walk that meets a face without area ends there.
    SurfacePoint operator()(const SurfacePoint& start, const Vec3& step) const;

  private:
    struct State;
    bool advance(State& state) const;
    void cross(State& state, int corner) const;

    const TriangleMesh& mesh_;
    std::vector<int> opposite_;  ///< opposite_half_edges (topology.h)
};

}  // namespace varimap
