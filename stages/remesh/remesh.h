#pragma once

#include <string>
#include <vector>

#include "varimap/mesh/surface.h"
#include "varimap/results/surface_map.h"

namespace varimap {

/// The source's input mesh (faces reversed if one of the two is mirrored, so that they show their outside)
/// with its vertices moved to their images, in the target's input coordinates. Vertices no face uses have no
/// image: they keep their place relative to the source's centroid, scaled like the target.
TriangleMesh cross_remesh(const PointMap& map, const Surface& source, const Surface& target);

/// `vertex,ratio`: transported mass by mass at the INPUT vertices that are samples of the plan; with the plan
/// of varimap-refine these are all vertices that faces use.
std::string masses_csv(const Surface& surface, const std::vector<int>& samples,
                       const Eigen::VectorXd& transported, const Eigen::VectorXd& mass);

}  // namespace varimap
