#pragma once

#include <Eigen/Geometry>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// Bounding box of the faces; vertices that no face uses do not count.
inline Eigen::AlignedBox3d bounds(const Points& vertices, const Faces& faces) {
    Eigen::AlignedBox3d box;
    for (int v : faces.reshaped()) box.extend(Vec3(vertices.row(v).transpose()));
    return box;
}

}  // namespace varimap
