#include "varimap/relaxation/movable_vertices.h"

#include "varimap/mesh/boundary.h"

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

VertexData<bool> with_boundary(VertexData<bool> marks, const TriangleMesh& mesh) {
    const VertexData<bool> rim = boundary_vertices(mesh, find_edges(mesh));
    for (int v = 0; v < marks.size(); ++v) marks[v] = marks[v] || rim[v];
    return marks;
}

}  // namespace varimap
