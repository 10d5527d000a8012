#pragma once

#include <string>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// Rotation from a mesh's coordinates to those of a viewer: rows point right, up, and towards the viewer.
using View = Eigen::Matrix3d;

/// Looks along a coordinate axis, at the side that shows much of the surface. `up` is "x", "y" or "z", "-x",
/// "-y" or "-z" where that axis points down, or "auto" (y or z: surfaces seen along the one have the other
/// upright; of those seen along x, the axis on which they stand on zero, else the shorter one, as four-legged
/// animals do).
View natural_view(const TriangleMesh& mesh, const std::string& up);

/// Of the 24 views along axes of `mesh`, that which shows the images of its vertices most like `other_view`
/// shows them: images has a row per vertex (any unit); rows where `has_image` is false do not count.
/// natural_view() where no view is better than it.
View matching_view(const TriangleMesh& mesh, const Points& images, const std::vector<bool>& has_image,
                   const View& other_view);

/// The view from a camera that moved around the up axis to the right, then up (degrees).
View moved(const View& view, double azimuth, double elevation);

}  // namespace varimap
