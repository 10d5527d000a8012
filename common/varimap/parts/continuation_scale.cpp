#include "varimap/parts/continuation_scale.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "varimap/mesh/face_geometry.h"

namespace varimap {

namespace {

constexpr double least_fit = 0.6, most_fit = 1.6;

VertexData<double> distances(const GeodesicGraph& graph, const std::vector<int>& sources) {
    VertexData<double> distance(graph.vertex_count(), std::numeric_limits<double>::infinity());
    GeodesicBall(graph).grow(sources, [&](int v, double d) {
        distance[v] = d;
        return true;
    });
    return distance;
}

/// The mapped vertices that are not open: those that share a face with one that is, their images, and the
/// images of the others.
struct Cut {
    std::vector<int> vertices, images, other_images;
};

Cut find_cut(const SlidingMap& map, const VertexData<bool>& open) {
    Cut cut;
    for (int v = 0; v < open.size(); ++v) {
        if (open[v] || !map.has_image(v)) continue;
        const auto faces = map.faces_of_vertex()[v];
        const bool at_cut = std::any_of(faces.begin(), faces.end(),
                                        [&](int f) { return marked_corners(map.source(), f, open) > 0; });
        if (at_cut) cut.vertices.push_back(v);
        (at_cut ? cut.images : cut.other_images).push_back(nearest_vertex(map.target(), map.point(v)));
    }
    return cut;
}

}  // namespace

double continuation_scale(const SlidingMap& map, const VertexData<bool>& open,
                          const GeodesicGraph& source_graph, const GeodesicGraph& target_graph) {
    const Cut cut = find_cut(map, open);
    if (cut.vertices.empty() || cut.other_images.empty()) return 1;
    const auto from_cut = distances(source_graph, cut.vertices);
    const auto from_image = distances(target_graph, cut.images),
               from_others = distances(target_graph, cut.other_images);
    double here = 0, there = 0;
    for (int v = 0; v < open.size(); ++v)
        if (open[v] && std::isfinite(from_cut[v])) here = std::max(here, from_cut[v]);
    for (int w = 0; w < from_image.size(); ++w)
        if (from_image[w] < from_others[w] && std::isfinite(from_image[w]))
            there = std::max(there, from_image[w]);
    return here > 0 && there > 0 ? std::clamp(there / here, least_fit, most_fit) : 1;
}

}  // namespace varimap
