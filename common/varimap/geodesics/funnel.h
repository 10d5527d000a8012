#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace varimap {

/// A segment of the plane, its ends to the left and to the right of the way that crosses it.
using Portal = std::pair<Eigen::Vector2d, Eigen::Vector2d>;

/// A path as funnel() finds it.
struct FunnelPath {
    double length = 0;                        ///< units of the plane
    std::vector<std::pair<int, bool>> bends;  ///< portals at whose left (true) or right end the path bends
};
/// Shortest path through the portals in their order, which bound a strip of triangles (Lee and Preparata
/// 1984).
FunnelPath funnel(const Eigen::Vector2d& start, const std::vector<Portal>& portals,
                  const Eigen::Vector2d& goal);

}  // namespace varimap
