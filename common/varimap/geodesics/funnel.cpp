#include "varimap/geodesics/funnel.h"

#include "varimap/core/plane.h"

namespace varimap {

FunnelPath funnel(const Eigen::Vector2d& start, const std::vector<Portal>& portals,
                  const Eigen::Vector2d& goal) {
    const int n = int(portals.size());
    FunnelPath path;
    Eigen::Vector2d apex = start, left = start, right = start;
    int left_index = -1, right_index = -1;
    const auto bend_at = [&](const Eigen::Vector2d& corner, int index, bool is_left) {
        path.length += (corner - apex).norm();
        path.bends.emplace_back(index, is_left);
        apex = left = right = corner;
        left_index = right_index = index;
    };
    for (int i = 0; i <= n; ++i) {
        const auto [l, r] = i < n ? portals[i] : Portal(goal, goal);
        if (cross(right - apex, r - apex) >= 0) {  // the right side does not widen
            if (apex != right && left != r && cross(left - apex, r - apex) > 0) {
                i = left_index;
                bend_at(Eigen::Vector2d(left), left_index, true);
                continue;
            }
            right = r, right_index = i;
        }
        if (cross(left - apex, l - apex) <= 0) {
            if (apex != left && right != l && cross(right - apex, l - apex) < 0) {
                i = right_index;
                bend_at(Eigen::Vector2d(right), right_index, false);
                continue;
            }
            left = l, left_index = i;
        }
    }
    path.length += (goal - apex).norm();
    return path;
}

}  // namespace varimap
