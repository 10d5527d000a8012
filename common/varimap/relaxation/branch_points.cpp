#include "varimap/relaxation/branch_points.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace varimap {

double winding_number(const SlidingMap& map, int v) {
    const auto faces = map.faces_of_vertex()[v];
    Vec3 axis = Vec3::Zero();
    std::vector<int> around;
    for (const int f : faces) {
        if (!map.is_mapped(f)) return 0;
        axis += map.mean_normal(f);
        const int k = map.corner_of(f, v);
        around.push_back(map.source().faces(f, (k + 1) % 3));
        around.push_back(map.source().faces(f, (k + 2) % 3));
    }
    axis.normalize();
    double turns = 0;
    for (std::size_t i = 0; i < around.size(); i += 2) {
        const Vec3 a = map.image(around[i]) - map.image(v), b = map.image(around[i + 1]) - map.image(v);
        turns += std::atan2(axis.dot(a.cross(b)), a.dot(b) - a.dot(axis) * b.dot(axis));
    }
    // On a boundary some vertex is beside one face only.
    std::sort(around.begin(), around.end());
    for (std::size_t i = 0; i < around.size(); i += 2)
        if (i + 1 == around.size() || around[i] != around[i + 1]) return 0;
    return turns / (2 * std::numbers::pi);
}

std::vector<int> branch_points(const SlidingMap& map, const std::vector<int>& vertices) {
    std::vector<int> found;
    for (const int v : vertices)
        if (winding_number(map, v) > 1.5) found.push_back(v);
    return found;
}

}  // namespace varimap
