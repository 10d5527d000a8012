#include "stages/explore/pool.h"

#include <algorithm>
#include <numeric>

namespace varimap {

namespace {

std::vector<int> after(const std::vector<int>& first, const std::vector<int>& then) {
    std::vector<int> composed;
    for (const int vertex : first) composed.push_back(then[std::size_t(vertex)]);
    return composed;
}

/// Where the nearest of the pairs that begin on the surface goes, per vertex.
std::vector<int> spread(const std::vector<std::pair<int, int>>& pairs, const TriangleMesh& mesh) {
    std::vector<int> images(std::size_t(mesh.vertex_count()), -1);
    for (const auto& [vertex, image] : pairs) images[std::size_t(vertex)] = image;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        if (images[std::size_t(v)] >= 0) continue;
        const auto nearest = std::min_element(pairs.begin(), pairs.end(), [&](const auto& p, const auto& q) {
            return (mesh.vertex(p.first) - mesh.vertex(v)).squaredNorm() <
                   (mesh.vertex(q.first) - mesh.vertex(v)).squaredNorm();
        });
        images[std::size_t(v)] = nearest->second;
    }
    return images;
}

}  // namespace

double share_elsewhere(const Points& a, const Points& b, const Surface& from, double elsewhere) {
    double share = 0;
    for (Eigen::Index v = 0; v < a.rows(); ++v)
        if ((a.row(v) - b.row(v)).norm() > elsewhere) share += from.mass[v];
    return share;
}

double difference(const VertexImages& a, const VertexImages& b, const Surface& A, const Surface& B) {
    constexpr double elsewhere = 0.15;  // units of sqrt(area); chosen by hand, not swept
    const auto at = [](const Surface& to, const std::vector<int>& images) {
        return Points(to.mesh.vertices(images, Eigen::all));
    };
    return (share_elsewhere(at(B, a.A_to_B), at(B, b.A_to_B), A, elsewhere) +
            share_elsewhere(at(A, a.B_to_A), at(A, b.B_to_A), B, elsewhere)) /
           2;
}

VertexImages identity(const Surface& surface) {
    VertexImages images;
    images.A_to_B.resize(std::size_t(surface.mesh.vertex_count()));
    std::iota(images.A_to_B.begin(), images.A_to_B.end(), 0);
    images.B_to_A = images.A_to_B;
    return images;
}

std::vector<VertexImages> images_of(const Candidates& self_maps, const Surface& surface) {
    std::vector<VertexImages> images;
    for (const Correspondences& map : self_maps.maps) {
        const VertexCorrespondences vertices = at_vertices(map, surface, surface);
        images.push_back({spread(vertices.from_A, surface.mesh), spread(vertices.from_B, surface.mesh)});
    }
    return images;
}

void add_if_new(std::vector<PooledMap>& pool, PooledMap map, const PairContext& context) {
    constexpr double close = 0.05;  // share of the surfaces; chosen by hand, not swept
    for (const PooledMap& other : pool)
        if (difference(map.images, other.images, context.A().surface, context.B().surface) < close) return;
    pool.push_back(std::move(map));
}

void compose(std::vector<PooledMap>& pool, int count, const std::vector<VertexImages>& self_maps_A,
             const std::vector<VertexImages>& self_maps_B, const PairContext& context) {
    const auto add = [&](PooledMap map) { add_if_new(pool, std::move(map), context); };
    for (int k = 0, first = int(pool.size()); k < std::min(count, first); ++k) {
        const PooledMap map = pool[std::size_t(k)];
        for (int s = 0; s < int(self_maps_B.size()); ++s) {
            const VertexImages& self = self_maps_B[std::size_t(s)];
            add({{after(map.images.A_to_B, self.A_to_B), after(self.B_to_A, map.images.B_to_A)},
                 {.explored = map.origin.explored, .self_map_B = s + 1}});
        }
        for (int s = 0; s < int(self_maps_A.size()); ++s) {
            const VertexImages& self = self_maps_A[std::size_t(s)];
            add({{after(self.A_to_B, map.images.A_to_B), after(map.images.B_to_A, self.B_to_A)},
                 {.explored = map.origin.explored, .self_map_A = s + 1}});
        }
    }
}

}  // namespace varimap
