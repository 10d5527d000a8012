#include "varimap/spectral/level_builder.h"

#include <functional>
#include <queue>
#include <tuple>

#include "varimap/core/index_set.h"
#include "varimap/core/parallel.h"
#include "varimap/spectral/neighbourhoods.h"
#include "varimap/spectral/sampling.h"

namespace varimap {

namespace {

/// Grows cells in the relative diffusion distance 1 - W, whose square root is d_diff / sqrt(K_x + K_p).
class DiffusionGrowth {
  public:
    DiffusionGrowth(const RowMatrix& embedding, const GeodesicGraph& graph)
        : embedding_(embedding),
          graph_(graph),
          kernel_(embedding.rowwise().squaredNorm()),
          seen_from_(graph.vertex_count(), -1) {}

    double relative_distance(int s, int v) const {
        return 1 - diffusion_weight(embedding_.row(s).dot(embedding_.row(v)), kernel_[s], kernel_[v]);
    }

    /// A vertex has one distance from the sample, whichever neighbour it is reached from: it is offered once.
    template <class Claim>
    void operator()(int sample, const Claim& claim) {
        queue_.clear();
        seen_from_[sample] = sample;
        if (claim(sample, 0)) queue_.push_back(sample);
        for (size_t head = 0; head < queue_.size(); ++head)
            for (int e = graph_.offset[queue_[head]]; e < graph_.offset[queue_[head] + 1]; ++e) {
                const int v = graph_.target[e];
                if (seen_from_[v] == sample) continue;
                seen_from_[v] = sample;
                if (claim(v, relative_distance(sample, v))) queue_.push_back(v);
            }
    }

  private:
    const RowMatrix& embedding_;
    const GeodesicGraph& graph_;
    Eigen::VectorXd kernel_;
    std::vector<int> seen_from_;  ///< per vertex: the last sample whose distance it was offered
    std::vector<int> queue_;
};

/// Grows cells in geodesic distance.
class GeodesicGrowth {
  public:
    explicit GeodesicGrowth(const GeodesicGraph& graph) : graph_(graph) {}

    template <class Claim>
    void operator()(int sample, const Claim& claim) const {
        using Entry = std::pair<double, int>;  // distance, vertex
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
        if (claim(sample, 0)) queue.push({0, sample});
        while (!queue.empty()) {
            const auto [distance, vertex] = queue.top();
            queue.pop();
            for (int e = graph_.offset[vertex]; e < graph_.offset[vertex + 1]; ++e) {
                const double d = distance + graph_.length[e];
                if (claim(graph_.target[e], d)) queue.push({d, graph_.target[e]});
            }
        }
    }

  private:
    const GeodesicGraph& graph_;
};

/// The domain's most extreme vertex: largest diagonal heat kernel; independent of numbering but for exact
/// ties.
int most_extreme_vertex(const RowMatrix& embedding) {
    int best = 0;
    for (int v = 1; v < embedding.rows(); ++v)
        if (float(embedding.row(v).squaredNorm()) > float(embedding.row(best).squaredNorm())) best = v;
    return best;
}

/// Samples, cells and masses of a level from a finished sampling.
template <class Grow>
Level level_from(const FarthestPointSampling<Grow>& sampling, LevelKind kind, double scale,
                 const Eigen::VectorXd& vertex_mass) {
    Level level;
    level.kind = kind;
    level.scale = scale;
    level.samples = sampling.samples();
    level.cell = sampling.cell();
    level.mass = Eigen::VectorXd::Zero(level.samples.size());
    for (size_t v = 0; v < level.cell.size(); ++v) level.mass[level.cell[v]] += vertex_mass[v];
    return level;
}

}  // namespace

Level LevelBuilder::diffusion(double time, const std::vector<int>& seeds, int limit) const {
    const RowMatrix embedding = diffusion_embedding(basis_, time);
    FarthestPointSampling sampling(domain_.mesh.vertex_count(), DiffusionGrowth(embedding, graph_));
    if (seeds.empty()) sampling.insert(most_extreme_vertex(embedding));
    for (int s : seeds) sampling.insert(s);
    sampling.cover(1 - options_.density, limit);
    return diffusion_level(sampling, time, embedding);
}

template <class Sampling>
Level LevelBuilder::diffusion_level(const Sampling& sampling, double time, const RowMatrix& embedding) const {
    Level level = level_from(sampling, LevelKind::diffusion, time, domain_.mass);
    level.weights = diffusion_weights(embedding(level.samples, Eigen::all), options_.truncation);
    return level;
}

/// Only the cells of the further samples are grown: those of the level's own are known.
Level LevelBuilder::diffusion_with(const Level& level, const std::vector<int>& further) const {
    const RowMatrix embedding = diffusion_embedding(basis_, level.scale);
    DiffusionGrowth growth(embedding, graph_);
    std::vector<double> distance(level.cell.size());
    parallel_for_each_index(int(distance.size()), 256, [&](int v) {
        const int sample = level.samples[level.cell[v]];
        distance[v] = v == sample ? 0 : growth.relative_distance(sample, v);
    });
    FarthestPointSampling sampling(level.samples, level.cell, std::move(distance), std::move(growth));
    for (const int v : further) sampling.insert(v);
    return diffusion_level(sampling, level.scale, embedding);
}

namespace {

FarthestPointSampling<GeodesicGrowth> geodesic_sampling(const GeodesicGraph& graph, double radius,
                                                        const std::vector<int>& seeds, int limit) {
    FarthestPointSampling sampling(graph.vertex_count(), GeodesicGrowth(graph));
    for (const int s : seeds) sampling.insert(s);
    sampling.cover(radius, limit);
    return sampling;
}

}  // namespace

Level LevelBuilder::euclidean(double sigma, const std::vector<int>& seeds, int limit) const {
    return euclidean_level(
        geodesic_sampling(graph_, sigma * gaussian_distance(options_.density), seeds, limit), sigma);
}

std::optional<Level> LevelBuilder::euclidean_up_to(int most, double sigma,
                                                   const std::vector<int>& seeds) const {
    const auto sampling =
        geodesic_sampling(graph_, sigma * gaussian_distance(options_.density), seeds, most + 1);
    if (int(sampling.samples().size()) > most) return {};
    return euclidean_level(sampling, sigma);
}

template <class Sampling>
Level LevelBuilder::euclidean_level(const Sampling& sampling, double sigma) const {
    Level level = level_from(sampling, LevelKind::euclidean, sigma, domain_.mass);
    const BallRule rule{sigma * gaussian_distance(options_.truncation), options_.minimum_neighbours,
                        options_.truncation};
    level.weights = geodesic_weights(level.samples, domain_, graph_, rule);
    return level;
}

Level LevelBuilder::full(int neighbours) const {
    Level level;
    level.kind = LevelKind::euclidean;
    level.full = true;
    level.samples = all_indices(domain_.mesh.vertex_count());
    level.cell = level.samples;
    level.mass = domain_.mass;
    level.weights = geodesic_weights(level.samples, domain_, graph_, {0, neighbours, options_.truncation});
    return level;
}

Level LevelBuilder::with_samples(const Level& level, const std::vector<int>& vertices) const {
    const std::vector<int> samples = samples_with(level, vertices);
    if (samples.size() == level.samples.size()) return level;
    if (level.kind == LevelKind::diffusion) return diffusion_with(level, vertices);
    return euclidean(level.scale, samples, int(samples.size()));
}

}  // namespace varimap
