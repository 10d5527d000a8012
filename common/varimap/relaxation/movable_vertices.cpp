#include "varimap/relaxation/movable_vertices.h"

namespace varimap {

std::vector<int> free_vertices(const SlidingMap& map, VertexData<bool> fixed,
                               const std::vector<SoftConstraint>& landmarks) {
    for (const SoftConstraint& landmark : landmarks) mark_corners(map.source(), landmark.from.face, fixed);
    std::vector<int> free;
    for (int v = 0; v < fixed.size(); ++v)
        if (!fixed[v] && map.has_image(v)) free.push_back(v);
    return free;
}

VertexData<bool> held_vertices(const SlidingMap& map, VertexData<bool> fixed,
                               const std::vector<SoftConstraint>& landmarks) {
    for (const SoftConstraint& landmark : landmarks)
        if (map.image_triangle(landmark.from.face).D > 0)
            mark_corners(map.source(), landmark.from.face, fixed);
    return fixed;
}

}  // namespace varimap
