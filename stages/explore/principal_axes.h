#pragma once

#include <Eigen/Core>

#include "varimap/surface/surface.h"

namespace varimap {

/// Principal axes of a surface, right-handed, and how far it reaches along them, the least first. Its
/// centroid is the origin.
struct PrincipalAxes {
    Eigen::Matrix3d axes;  ///< columns
    Eigen::Vector3d deviation;
};
PrincipalAxes principal_axes(const Surface& surface);

}  // namespace varimap
