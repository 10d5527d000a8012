#include "varimap/relaxation/mirrored_parts.h"

#include <algorithm>
#include <utility>

namespace varimap {

namespace {

ReversedPatch measure(const SlidingMap& map, const Edges& edges, const std::vector<char>& reversed,
                      std::vector<int> faces) {
    ReversedPatch patch;
    int interior = 0;
    double signed_area = 0;
    for (const int f : faces) {
        patch.area += map.rest(f).area;
        signed_area += map.rest(f).area * map.image_triangle(f).D;
        bool surrounded = true;
        for (int k = 0; k < 3; ++k)
            for (const int side : edges.sides[edges.of_side[std::size_t(3 * f + k)]])
                surrounded = surrounded && reversed[std::size_t(side / 3)];
        interior += surrounded;
    }
    patch.ratio = signed_area / patch.area;
    patch.interior = double(interior) / double(faces.size());
    std::sort(faces.begin(), faces.end());
    patch.faces = std::move(faces);
    return patch;
}

}  // namespace

std::vector<ReversedPatch> reversed_patches(const SlidingMap& map) {
    const int n = map.source().face_count();
    std::vector<char> reversed(std::size_t(n), 0);
    bool any = false;
    for (int f = 0; f < n; ++f) {
        reversed[std::size_t(f)] = map.is_mapped(f) && map.image_triangle(f).D <= 0;
        any = any || reversed[std::size_t(f)];
    }
    std::vector<ReversedPatch> patches;
    if (!any) return patches;
    const Edges edges = find_edges(map.source());
    for (auto& faces : face_components(edges, reversed))
        patches.push_back(measure(map, edges, reversed, std::move(faces)));
    std::stable_sort(patches.begin(), patches.end(),
                     [](const auto& a, const auto& b) { return a.area > b.area; });
    return patches;
}

}  // namespace varimap
