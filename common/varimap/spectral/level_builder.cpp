#include "varimap/spectral/level_builder.h"

#include <functional>
#include <limits>
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

Level LevelBuilder::diffusion_cells(double time, const std::vector<int>& seeds, int limit) const {
    const RowMatrix embedding = diffusion_embedding(basis_, time);
    FarthestPointSampling sampling(domain_.mesh.vertex_count(), DiffusionGrowth(embedding, graph_));
    if (seeds.empty()) sampling.insert(most_extreme_vertex(embedding));
    for (int s : seeds) sampling.insert(s);
    sampling.cover(1 - options_.density, limit);
    return level_from(sampling, LevelKind::diffusion, time, domain_.mass);
}

void LevelBuilder::weigh(Level& level) const {
    level.weights =
        diffusion_weights(diffusion_embedding(basis_, level.scale, level.samples), options_.truncation);
}

LevelBuilder::Euclidean LevelBuilder::euclidean(double sigma, const std::vector<int>& seeds,
                                                std::optional<int> least, int most) const {
    const double radius = sigma * gaussian_distance(options_.density);
    FarthestPointSampling sampling(graph_.vertex_count(), GeodesicGrowth(graph_));
    for (const int s : seeds) sampling.insert(s);
    std::optional<FarthestPointSampling<GeodesicGrowth>> at_least;
    if (least) {
        sampling.cover(radius, *least);
        at_least.emplace(sampling);
    }
    sampling.cover(radius, most + 1);
    Euclidean result;
    if (int(sampling.samples().size()) <= most)
        result.dense = euclidean_level(sampling, sigma);
    else if (at_least)
        result.least = euclidean_level(*at_least, sigma);
    return result;
}

BallRule LevelBuilder::ball_rule(double sigma) const {
    return {sigma * gaussian_distance(options_.truncation), options_.minimum_neighbours, options_.truncation};
}

template <class Sampling>
Level LevelBuilder::euclidean_level(const Sampling& sampling, double sigma) const {
    Level level = level_from(sampling, LevelKind::euclidean, sigma, domain_.mass);
    level.weights = geodesic_weights(level.samples, domain_, graph_, ball_rule(sigma));
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

// Only the cells of the further samples are grown, and neighbourhoods near them: the others are known.

Level LevelBuilder::diffusion_cells_with(const Level& level, const std::vector<int>& vertices,
                                         const RowMatrix& embedding) const {
    if (samples_with(level, vertices).size() == level.samples.size()) return level;
    DiffusionGrowth growth(embedding, graph_);
    std::vector<double> distance(level.cell.size());
    parallel_for_each_index(int(distance.size()), 256, [&](int v) {
        const int sample = level.samples[level.cell[v]];
        distance[v] = v == sample ? 0 : growth.relative_distance(sample, v);
    });
    FarthestPointSampling sampling(level.samples, level.cell, std::move(distance), std::move(growth));
    for (const int v : vertices) sampling.insert(v);
    return level_from(sampling, LevelKind::diffusion, level.scale, domain_.mass);
}

Level LevelBuilder::diffusion_with(const Level& level, const std::vector<int>& vertices,
                                   const RowMatrix& embedding) const {
    Level with = diffusion_cells_with(level, vertices, embedding);
    if (with.samples.size() > level.samples.size())
        with.weights =
            more_diffusion_weights(level.weights, embedding(with.samples, Eigen::all), options_.truncation);
    return with;
}

Level LevelBuilder::euclidean_with(const Level& level, const std::vector<int>& vertices) const {
    if (samples_with(level, vertices).size() == level.samples.size()) return level;
    std::vector<double> distance(level.cell.size(), std::numeric_limits<double>::infinity());
    GeodesicBall(graph_).grow(level.samples, [&](int v, double d) { return distance[v] = d, true; });
    FarthestPointSampling sampling(level.samples, level.cell, std::move(distance), GeodesicGrowth(graph_));
    for (const int v : vertices) sampling.insert(v);
    Level with = level_from(sampling, LevelKind::euclidean, level.scale, domain_.mass);
    with.weights =
        more_geodesic_weights(level.weights, with.samples, domain_, graph_, ball_rule(level.scale));
    return with;
}

}  // namespace varimap
