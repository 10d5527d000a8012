#include "stages/explore/self_maps.h"

#include <algorithm>
#include <cmath>

#include "stages/explore/appraisal.h"
#include "stages/explore/candidate_maps.h"
#include "stages/explore/difference.h"
#include "varimap/core/index_set.h"
#include "varimap/core/timing.h"
#include "varimap/results/read_out.h"

namespace varimap {

namespace {

VertexImages identity(const Surface& surface) {
    const std::vector<int> own = all_indices(surface.mesh.vertex_count());
    return {own, own};
}

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

ExplorationOptions self_map_options(const ExploreParams& params) {
    ExplorationOptions options = params.exploration;
    options.area_bound = 1;  // the surface has the areas it has
    options.distinct = 0.4;
    options.random_starts *= 2;
    options.candidates = 4;
    options.last_samples = 400;  // rougher self-maps composed are no good
    return options;
}

Candidates find_self_maps(const PairContext& context, const ExploreParams& params) {
    constexpr double another = 0.1;  // share of the surface that a self-map moves; chosen by hand
    const std::vector<PooledMap> pool = explored(context, self_map_options(params), params);
    const Surface& surface = context.A().surface;
    const MapPair same{points_at_vertices(surface.mesh), points_at_vertices(surface.mesh)};
    Candidates found;
    for (const PooledMap& map : pool) {
        if (difference(map.images, identity(surface), surface, surface) < another) continue;
        const MapPair maps{images_at(map.images.A_to_B, surface.mesh),
                           images_at(map.images.B_to_A, surface.mesh)};
        Candidate candidate = map.origin;
        candidate.score = std::log(map.origin.energy / pool.front().origin.energy);
        compare(same, maps, context, candidate);
        found.list.push_back(candidate);
        found.maps.push_back(correspondences(maps, surface, surface));
    }
    return found;
}

SelfMapsOnDemand find_when_asked(const PairContext& pair, const ExploreParams& params) {
    const auto found = [&params](const SurfaceData& surface) {
        const Timer timer("self-maps");
        return find_self_maps({surface, surface, {}}, params);
    };
    return {[&pair, found] { return found(pair.A()); }, [&pair, found] { return found(pair.B()); }};
}

std::vector<VertexImages> images_of(const Candidates& self_maps, const Surface& surface) {
    std::vector<VertexImages> images;
    for (const Correspondences& map : self_maps.maps) {
        const VertexCorrespondences vertices = at_vertices(map, surface, surface);
        images.push_back({spread(vertices.from_A, surface.mesh), spread(vertices.from_B, surface.mesh)});
    }
    return images;
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

const std::vector<VertexImages>& LazySelfMaps::OfOne::images(const Surface& surface) {
    if (!found) found = images_of(ask(), surface);
    return *found;
}

void LazySelfMaps::add_compositions(std::vector<PooledMap>& pool, int count) {
    if (!exist()) return;
    compose(pool, count, A_.images(context_.A().surface), B_.images(context_.B().surface), context_);
}

void LazySelfMaps::add_compositions_with_B(std::vector<PooledMap>& pool, int count) {
    if (!exist()) return;
    compose(pool, count, {}, B_.images(context_.B().surface), context_);
}

}  // namespace varimap
