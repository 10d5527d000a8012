#include "stages/explore/pool.h"

#include "stages/explore/difference.h"
#include "stages/explore/exploration.h"
#include "varimap/core/timing.h"
#include "varimap/mesh/face_geometry.h"

namespace varimap {

namespace {

std::vector<int> nearest_vertices(const PointMap& map, const TriangleMesh& to) {
    std::vector<int> vertices;
    for (const SurfacePoint& point : map) vertices.push_back(nearest_vertex(to, point));
    return vertices;
}

std::vector<PooledMap> pool_of(const Exploration& exploration, const std::vector<Trial>& trials) {
    std::vector<PooledMap> pool;
    for (const Trial& trial : trials)
        if (pool.empty() || !trial.is_mirrored())
            pool.push_back(
                {exploration.images(trial), {.explored = int(pool.size()) + 1, .energy = trial.energy()}});
    return pool;
}

}  // namespace

MapStart start_of(const PooledMap& map) {
    return [&images = map.images](const LevelPair& level) { return matching_of(images, level); };
}

VertexImages vertex_images(const MapPair& maps, const PairContext& context) {
    return {nearest_vertices(maps.A_to_B, context.B().surface.mesh),
            nearest_vertices(maps.B_to_A, context.A().surface.mesh)};
}

ExplorationProgress coarsely_explored(const PairContext& context, const ExplorationOptions& options,
                                      const ExploreParams& params) {
    const Timer timer("exploration");
    return Exploration(context, options, params.alternation, params.ironing).coarse_levels();
}

std::vector<PooledMap> explored(const PairContext& context, const ExplorationOptions& options,
                                const ExploreParams& params) {
    const Timer timer("exploration");
    Exploration exploration(context, options, params.alternation, params.ironing);
    return pool_of(exploration, exploration.go_on(exploration.coarse_levels()));
}

std::vector<PooledMap> explored(const PairContext& context, const ExplorationProgress& coarse,
                                const ExplorationOptions& options, const ExploreParams& params) {
    const Timer timer("exploration");
    Exploration exploration(context, options, params.alternation, params.ironing);
    return pool_of(exploration, exploration.go_on(coarse));
}

std::vector<PooledMap> from_axes(const PairContext& context, int count, const ExploreParams& params) {
    const Timer timer("exploration");
    ExplorationOptions options = params.exploration;
    options.axes_maps = count;
    Exploration exploration(context, options, params.alternation, params.ironing);
    return pool_of(exploration, exploration.from_axes());
}

std::vector<PooledMap> led_by_landmarks(const PairContext& context, const ExploreParams& params) {
    if (context.landmarks().empty()) return {};
    Exploration exploration(context, params.exploration, params.alternation, params.ironing);
    const Trial trial = exploration.follow_landmarks();
    return {{exploration.images(trial), {.explored = 0, .energy = trial.energy()}}};
}

std::vector<PooledMap> pooled(std::vector<PooledMap> led,
                              const std::vector<std::vector<PooledMap>>& explorations,
                              const PairContext& context) {
    int found = 0;
    for (const std::vector<PooledMap>& maps : explorations)
        for (PooledMap map : maps) {
            map.origin.explored = ++found;
            add_if_new(led, std::move(map), context);
        }
    return led;
}

void add_if_new(std::vector<PooledMap>& pool, PooledMap map, const PairContext& context) {
    constexpr double close = 0.05;  // share of the surfaces; chosen by hand, not swept
    for (const PooledMap& other : pool)
        if (difference(map.images, other.images, context.A().surface, context.B().surface) < close) return;
    pool.push_back(std::move(map));
}

}  // namespace varimap
