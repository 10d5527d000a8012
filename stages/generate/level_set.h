#pragma once

#include <functional>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap::shapes {

/// The zero level of `f` (negative inside, positive on the box's border) by marching tetrahedra, vertices
/// projected onto the level set.
TriangleMesh level_set(const std::function<double(const Vec3&)>& f, const Vec3& low, const Vec3& high,
                       double cell);

}  // namespace varimap::shapes
