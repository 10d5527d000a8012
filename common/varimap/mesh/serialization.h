#pragma once

#include "varimap/artifact/cereal_eigen.h"
#include "varimap/mesh/triangle_mesh.h"

/// What cereal writes of the parts of a mesh that several artifacts share.
namespace varimap {

template <class Archive>
void serialize(Archive& archive, SurfacePoint& point) {
    archive(point.face, point.barycentric);
}

}  // namespace varimap
