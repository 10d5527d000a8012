#include "common/mapping/mirrored_parts.h"

#include <algorithm>

namespace varimap {

namespace {

/// Collects the patch that holds `seed` and clears its marks in `open`.
ReversedPatch collect(const MovingMap& map, const Edges& edges, const std::vector<char>& reversed,
                      std::vector<char>& open, int seed) {
    ReversedPatch patch;
    int interior = 0;
    double signed_area = 0;
    patch.faces = {seed};
    open[std::size_t(seed)] = 0;
    for (std::size_t i = 0; i < patch.faces.size(); ++i) {
        const int f = patch.faces[i];
        patch.area += map.rest(f).area;
        signed_area += map.rest(f).area * map.chord(f).D;
        bool surrounded = true;
        for (int k = 0; k < 3; ++k)
            for (const int side : edges.sides[edges.of_side[std::size_t(3 * f + k)]]) {
                const int g = side / 3;
                surrounded = surrounded && reversed[std::size_t(g)];
                if (open[std::size_t(g)]) patch.faces.push_back(g);
                open[std::size_t(g)] = 0;
            }
        interior += surrounded;
    }
    std::sort(patch.faces.begin(), patch.faces.end());
    patch.ratio = signed_area / patch.area;
    patch.interior = double(interior) / double(patch.faces.size());
    return patch;
}

}  // namespace

std::vector<ReversedPatch> reversed_patches(const MovingMap& map) {
    const int n = map.source().face_count();
    std::vector<char> reversed(std::size_t(n), 0);
    bool any = false;
    for (int f = 0; f < n; ++f) {
        reversed[std::size_t(f)] = map.is_mapped(f) && map.chord(f).D <= 0;
        any = any || reversed[std::size_t(f)];
    }
    std::vector<ReversedPatch> patches;
    if (!any) return patches;
    const Edges edges = find_edges(map.source());
    std::vector<char> open = reversed;
    for (int f = 0; f < n; ++f)
        if (open[std::size_t(f)]) patches.push_back(collect(map, edges, reversed, open, f));
    std::stable_sort(patches.begin(), patches.end(),
                     [](const auto& a, const auto& b) { return a.area > b.area; });
    return patches;
}

}  // namespace varimap
