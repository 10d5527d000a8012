#pragma once

#include <embree3/rtcore.h>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// The faces of a mesh as Embree holds them: at (x - centre) * scale, in single precision, without gaps along
/// edges. Face f is primitive f. Throws Error where Embree cannot start.
class EmbreeScene {
  public:
    EmbreeScene(const TriangleMesh& mesh, const Vec3& centre, double scale);
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;

    RTCScene get() const { return scene_; }

  private:
    RTCDevice device_;
    RTCScene scene_;
};

}  // namespace varimap
