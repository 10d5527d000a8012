#pragma once

#include <optional>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// How often `image`, whose vertices lie on `target`, covers it, both closed: the mean over points inside the
/// target, spread evenly under its surface, of the image's winding number by the target's own. Each is an
/// integer; if the image follows the surface, all are the degree of the map, and they differ where it cuts
/// off a part or wraps it another number of times. For an embedded surface this is the degree itself, found
/// without judging any triangle.
///
/// A point is the centre of a ball inside the target that touches it at a sample (shrinking ball: Ma, Bae and
/// Choi 2012). Left out are points to which the image comes closer than half the ball's radius, and those
/// in parts thinner than the image's mean edge, which its triangles cannot follow. None if no point is left.
std::optional<double> map_degree(const TriangleMesh& image, const TriangleMesh& target);

}  // namespace varimap
