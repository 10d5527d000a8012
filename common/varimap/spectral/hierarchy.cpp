#include "varimap/spectral/hierarchy.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "varimap/artifact/cereal_eigen.h"
#include "varimap/core/log.h"
#include "varimap/spectral/neighbourhoods.h"
#include "varimap/spectral/spectral_check.h"

namespace varimap {

namespace {

void append(std::vector<Level>& levels, Level level) {
    const bool diffusion = level.kind == LevelKind::diffusion;
    log("level {} {} {} {:.4g}: {} samples, {:.1f} neighbours", levels.size(),
        diffusion ? "diffusion" : "euclidean", diffusion ? "t" : "sigma", level.scale, level.samples.size(),
        double(level.weights.nonZeros()) / double(level.samples.size()));
    levels.push_back(std::move(level));
}

void append_diffusion_levels(std::vector<Level>& levels, const Basis& basis, double growth,
                             const LevelBuilder& builder) {
    // Growth says nothing while the number of samples is still below that of the eigenfunctions.
    const size_t meaningful = size_t(basis.eigenvalues.size());
    const int half = int(basis.functions.rows()) / 2;
    constexpr int most_levels = 60;  // times are halved: far below what any mesh resolves
    std::vector<int> samples;
    for (int l = 0; l < most_levels; ++l) {
        const double time = std::ldexp(coarsest_time(basis), -l);
        Level level = builder.diffusion_cells(time, samples, std::max(half, 2));
        const size_t before = samples.size(), now = level.samples.size();
        if (l > 0 && now >= meaningful && double(now) < growth * double(before)) return;
        builder.weigh(level);
        samples = level.samples;
        append(levels, std::move(level));
        if (int(now) >= half) return;
    }
}

void append_euclidean_levels(std::vector<Level>& levels, const GeodesicGraph& graph,
                             const HierarchyOptions& options, const LevelBuilder& builder) {
    const int half = graph.vertex_count() / 2;
    double sigma = average_radius(levels.back().samples, levels.back().weights, graph) /
                   gaussian_distance(options.truncation);
    // Neighbourhoods on the last level are too small to move a patch: the one before must be fine enough.
    const int least = int(options.sampled_share * graph.vertex_count());
    const auto is_fine_enough = [&] {
        return levels.back().kind == LevelKind::euclidean && int(levels.back().samples.size()) >= least;
    };
    while (true) {
        // Past half of the vertices a level of its own is not worth its time.
        LevelBuilder::Euclidean level =
            builder.euclidean(sigma, levels.back().samples,
                              is_fine_enough() ? std::nullopt : std::optional(least), sigma > 0 ? half : 0);
        if (level.least) append(levels, std::move(*level.least));
        if (!level.dense) break;
        append(levels, std::move(*level.dense));
        sigma /= 2;
    }
    append(levels, builder.full(options.last_neighbours));
}

}  // namespace

int Hierarchy::diffusion_levels() const {
    return int(std::count_if(levels.begin(), levels.end(),
                             [](const Level& l) { return l.kind == LevelKind::diffusion; }));
}

int Hierarchy::sampled_euclidean_levels() const {
    return int(levels.size()) - diffusion_levels() - 1;
}

Hierarchy build_hierarchy(const Domain& domain, const Basis& basis, const HierarchyOptions& options) {
    const GeodesicGraph graph(domain);
    const LevelBuilder builder(domain, basis, graph, options);
    Hierarchy hierarchy{options, {}, local_shape(domain, basis)};
    append_diffusion_levels(hierarchy.levels, basis, options.growth, builder);
    append_euclidean_levels(hierarchy.levels, graph, options, builder);
    return hierarchy;
}

template <class Archive>
void serialize(Archive& archive, Level& level) {
    archive(level.kind, level.scale, level.full, level.samples, level.cell, level.mass, level.weights);
}
template <class Archive>
void serialize(Archive& archive, HierarchyOptions& o) {
    archive(o.truncation, o.density, o.growth, o.minimum_neighbours, o.sampled_share, o.last_neighbours);
}
template <class Archive>
void serialize(Archive& archive, LocalShape& shape) {
    archive(shape.descriptors, shape.bending);
}
template <class Archive>
void serialize(Archive& archive, Hierarchy& hierarchy) {
    archive(hierarchy.options, hierarchy.levels, hierarchy.shape);
}
std::string encode(const Hierarchy& hierarchy) {
    return cereal_encode(hierarchy);
}
void decode(const std::string& payload, Hierarchy& hierarchy) {
    cereal_decode(payload, hierarchy);
    require_complete(hierarchy);
}

std::vector<int> spread_vertices(const Hierarchy& hierarchy, std::size_t count) {
    const std::vector<Level>& levels = hierarchy.levels;
    auto level =
        std::find_if(levels.begin(), levels.end(), [&](const Level& l) { return l.samples.size() >= count; });
    if (level == levels.end()) --level;
    const std::vector<int>& samples = level->samples;
    return {samples.begin(), samples.begin() + std::ptrdiff_t(std::min(samples.size(), count))};
}

}  // namespace varimap
