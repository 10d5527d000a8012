#include "varimap/parts/mirrored_parts.h"

#include <algorithm>
#include <utility>

namespace varimap {

namespace {

ReversedPatch measure(const SlidingMap& map, const Edges& edges, const FaceData<bool>& reversed,
                      std::vector<int> faces) {
    ReversedPatch patch;
    int interior = 0;
    double signed_area = 0;
    for (const int f : faces) {
        patch.area += map.rest(f).area;
        signed_area += map.rest(f).area * map.image_triangle(f).D;
        bool surrounded = true;
        for (int k = 0; k < 3; ++k)
            for (const int half_edge : edges.half_edges[edges.of_half_edge[3 * f + k]])
                surrounded = surrounded && reversed[half_edge / 3];
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
    FaceData<bool> reversed(map.source().face_count());
    bool any = false;
    for (int f = 0; f < reversed.size(); ++f) {
        reversed[f] = map.is_mapped(f) && map.image_triangle(f).D <= 0;
        any = any || reversed[f];
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
