#include "varimap/spectral/hierarchy.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>
#include <tuple>

#include "varimap/artifact/cereal_eigen.h"
#include "varimap/core/log.h"
#include "varimap/core/parallel.h"
#include "varimap/spectral/sampling.h"

namespace varimap {

namespace {

using Neighbourhood = std::vector<std::pair<int, double>>;  // (sample, weight)

SparseMatrix to_matrix(const std::vector<Neighbourhood>& rows) {
    SparseMatrix matrix(rows.size(), rows.size());
    std::vector<int> sizes(rows.size());
    for (size_t k = 0; k < rows.size(); ++k) sizes[k] = int(rows[k].size());
    matrix.reserve(sizes);
    for (size_t k = 0; k < rows.size(); ++k)
        for (const auto& [i, w] : rows[k]) matrix.insert(k, i) = w;
    matrix.makeCompressed();
    return matrix;
}

Eigen::VectorXd cell_masses(const std::vector<int>& cell, const Eigen::VectorXd& vertex_mass,
                            size_t samples) {
    Eigen::VectorXd mass = Eigen::VectorXd::Zero(samples);
    for (size_t v = 0; v < cell.size(); ++v) mass[cell[v]] += vertex_mass[v];
    return mass;
}

/// Grows cells in the relative diffusion distance 1 - W, whose square root is d_diff / sqrt(K_x + K_p).
FarthestPointSampling::Grow diffusion_growth(const RowMatrix& embedding, const GeodesicGraph& graph) {
    const Eigen::VectorXd kernel = embedding.rowwise().squaredNorm();
    return [&embedding, &graph, kernel, queue = std::vector<int>()](
               int sample, const FarthestPointSampling::Claim& claim) mutable {
        const auto relative_distance = [&](int v) {
            return 1 - 2 * embedding.row(sample).dot(embedding.row(v)) / (kernel[sample] + kernel[v]);
        };
        queue.clear();
        if (claim(sample, 0)) queue.push_back(sample);
        for (size_t head = 0; head < queue.size(); ++head)
            for (int e = graph.offset[queue[head]]; e < graph.offset[queue[head] + 1]; ++e)
                if (claim(graph.target[e], relative_distance(graph.target[e])))
                    queue.push_back(graph.target[e]);
    };
}

/// Grows cells in geodesic distance.
FarthestPointSampling::Grow geodesic_growth(const GeodesicGraph& graph) {
    struct Entry {
        double distance;
        int vertex;
        bool operator>(const Entry& o) const {
            return std::tie(distance, vertex) > std::tie(o.distance, o.vertex);
        }
    };
    return [&graph](int sample, const FarthestPointSampling::Claim& claim) {
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
        if (claim(sample, 0)) queue.push({0, sample});
        while (!queue.empty()) {
            const Entry top = queue.top();
            queue.pop();
            for (int e = graph.offset[top.vertex]; e < graph.offset[top.vertex + 1]; ++e) {
                const double d = top.distance + graph.length[e];
                if (claim(graph.target[e], d)) queue.push({d, graph.target[e]});
            }
        }
    };
}

/// The surface's most extreme vertex: largest diagonal heat kernel; independent of numbering but for exact
/// ties.
int most_extreme_vertex(const RowMatrix& embedding) {
    int best = 0;
    for (int v = 1; v < embedding.rows(); ++v)
        if (float(embedding.row(v).squaredNorm()) > float(embedding.row(best).squaredNorm())) best = v;
    return best;
}

/// Shared by both kinds of levels: samples, cells and masses from a finished sampling.
Level level_from(const FarthestPointSampling& sampling, LevelKind kind, double scale,
                 const Surface& surface) {
    Level level;
    level.kind = kind;
    level.scale = scale;
    level.samples = sampling.samples();
    level.cell = sampling.cell();
    level.mass = cell_masses(level.cell, surface.mass, level.samples.size());
    return level;
}

Level diffusion_level(double time, const std::vector<int>& seeds, int limit, const Surface& surface,
                      const Basis& basis, const GeodesicGraph& graph, const HierarchyOptions& options) {
    const RowMatrix embedding = diffusion_embedding(basis, time);
    FarthestPointSampling sampling(surface.mesh.vertex_count(), diffusion_growth(embedding, graph));
    if (seeds.empty()) sampling.insert(most_extreme_vertex(embedding));
    for (int s : seeds) sampling.insert(s);
    sampling.cover(1 - options.density, limit);
    Level level = level_from(sampling, LevelKind::diffusion, time, surface);
    level.weights = diffusion_weights(embedding(level.samples, Eigen::all), options.truncation);
    return level;
}

/// What a Euclidean neighbourhood must reach, and the rule that turns its radius into sigma.
struct BallRule {
    double radius = 0;           ///< geodesic radius at which W = epsilon
    int minimum_neighbours = 1;  ///< grow beyond the radius until it holds that many
};

/// Gaussian weights along the surface (Eq. 11 with geodesic distances), among samples whose normals agree:
/// balls in R^3, or across a thin sheet, would bridge limbs that only touch.
SparseMatrix geodesic_weights(const std::vector<int>& samples, const Surface& surface,
                              const GeodesicGraph& graph, const BallRule& rule, double truncation) {
    const Points normals = vertex_normals(surface.mesh);
    std::vector<int> index(surface.mesh.vertex_count(), -1);
    for (size_t k = 0; k < samples.size(); ++k) index[samples[k]] = int(k);
    const double reach = std::sqrt(-2 * std::log(truncation));  // radius / sigma

    std::vector<Neighbourhood> rows(samples.size());
    tbb::parallel_for(tbb::blocked_range<size_t>(0, samples.size(), 256), [&](const auto& range) {
        GeodesicBall ball(graph);
        for (size_t k = range.begin(); k < range.end(); ++k) {
            Neighbourhood& row = rows[k];
            double radius = rule.radius;
            const int limit = std::min<int>(rule.minimum_neighbours, int(samples.size()));
            ball.grow(samples[k], [&](int v, double d) {
                if (d > radius * (1 + 1e-9) && int(row.size()) >= limit) return false;
                if (index[v] < 0) return true;
                if (int(row.size()) < limit) radius = std::max(radius, d);
                if (normals.row(v).dot(normals.row(samples[k])) > 0 || v == samples[k])
                    row.emplace_back(index[v], d);
                return true;
            });
            const double sigma = radius / reach;
            for (auto& [i, d] : row) d = sigma > 0 ? std::exp(-d * d / (2 * sigma * sigma)) : 1.0;
            std::sort(row.begin(), row.end());
        }
    });
    return to_matrix(rows);
}

/// Average over samples of the geodesic distance to the farthest member of their neighbourhoods.
double average_radius(const Level& level, const GeodesicGraph& graph) {
    std::vector<double> radius(level.samples.size());
    tbb::parallel_for(tbb::blocked_range<size_t>(0, radius.size(), 32), [&](const auto& range) {
        GeodesicBall ball(graph);
        std::vector<char> wanted(graph.vertex_count(), 0);
        for (size_t k = range.begin(); k < range.end(); ++k) {
            int missing = 0;
            for (SparseMatrix::InnerIterator it(level.weights, k); it; ++it, ++missing)
                wanted[level.samples[it.col()]] = 1;
            ball.grow(level.samples[k], [&](int v, double d) {
                if (wanted[v]) radius[k] = d, wanted[v] = 0, --missing;
                return missing > 0;
            });
            for (SparseMatrix::InnerIterator it(level.weights, k); it; ++it)
                wanted[level.samples[it.col()]] = 0;
        }
    });
    return std::accumulate(radius.begin(), radius.end(), 0.0) / double(radius.size());
}

Level sampled_euclidean_level(double sigma, const std::vector<int>& seeds, int limit, const Surface& surface,
                              const GeodesicGraph& graph, const HierarchyOptions& options) {
    FarthestPointSampling sampling(surface.mesh.vertex_count(), geodesic_growth(graph));
    for (int s : seeds) sampling.insert(s);
    sampling.cover(sigma * std::sqrt(-2 * std::log(options.density)), limit);
    Level level = level_from(sampling, LevelKind::euclidean, sigma, surface);
    const BallRule rule{sigma * std::sqrt(-2 * std::log(options.truncation)), options.minimum_neighbours};
    level.weights = geodesic_weights(level.samples, surface, graph, rule, options.truncation);
    return level;
}

/// Every vertex a sample, with a sigma of its own: the distance to its `neighbours`-th neighbour has W =
/// epsilon.
Level full_euclidean_level(int neighbours, const Surface& surface, const GeodesicGraph& graph,
                           const HierarchyOptions& options) {
    Level level;
    level.kind = LevelKind::euclidean;
    level.samples.resize(surface.mesh.vertex_count());
    std::iota(level.samples.begin(), level.samples.end(), 0);
    level.cell = level.samples;
    level.mass = surface.mass;
    level.weights = geodesic_weights(level.samples, surface, graph, {0, neighbours}, options.truncation);
    return level;
}

void log_level(size_t index, const Level& level) {
    log("level {} {} {} {:.4g}: {} samples, {:.1f} neighbours", index,
        level.kind == LevelKind::diffusion ? "diffusion" : "euclidean",
        level.kind == LevelKind::diffusion ? "t" : "sigma", level.scale, level.samples.size(),
        double(level.weights.nonZeros()) / double(level.samples.size()));
}

void append_diffusion_levels(Hierarchy& hierarchy, const Surface& surface, const Basis& basis,
                             const GeodesicGraph& graph, const HierarchyOptions& options) {
    // Growth says nothing while the number of samples is still below that of the eigenfunctions.
    const size_t meaningful = size_t(basis.eigenvalues.size());
    const int half = surface.mesh.vertex_count() / 2;
    constexpr int most_levels = 60;
    std::vector<int> samples;
    for (int l = 0; l < most_levels; ++l) {
        const double time = std::ldexp(coarsest_time(basis), -l);
        Level level = diffusion_level(time, samples, std::max(half, 2), surface, basis, graph, options);
        const size_t before = samples.size(), now = level.samples.size();
        if (l > 0 && now >= meaningful && double(now) < options.growth * double(before)) return;
        samples = level.samples;
        log_level(hierarchy.levels.size(), level);
        hierarchy.levels.push_back(std::move(level));
        if (int(now) >= half) return;
    }
}

void append_euclidean_levels(Hierarchy& hierarchy, const Surface& surface, const GeodesicGraph& graph,
                             const HierarchyOptions& options) {
    const int half = surface.mesh.vertex_count() / 2;
    const double reach = std::sqrt(-2 * std::log(options.truncation));
    double sigma = average_radius(hierarchy.levels.back(), graph) / reach;
    for (;; sigma /= 2) {
        const auto& seeds = hierarchy.levels.back().samples;
        Level level = sampled_euclidean_level(sigma, seeds, half + 1, surface, graph, options);
        // Past half of the vertices a level of its own is not worth its time: take them all.
        if (int(level.samples.size()) > half || !(sigma > 0)) break;
        log_level(hierarchy.levels.size(), level);
        hierarchy.levels.push_back(std::move(level));
    }
    for (int neighbours : {options.full_neighbours, options.last_neighbours}) {
        hierarchy.levels.push_back(full_euclidean_level(neighbours, surface, graph, options));
        log_level(hierarchy.levels.size() - 1, hierarchy.levels.back());
    }
}

}  // namespace

int Hierarchy::diffusion_levels() const {
    return int(std::count_if(levels.begin(), levels.end(),
                             [](const Level& l) { return l.kind == LevelKind::diffusion; }));
}

SparseMatrix diffusion_weights(const RowMatrix& embedding, double truncation) {
    const int n = int(embedding.rows());
    const Eigen::VectorXd kernel = embedding.rowwise().squaredNorm();
    std::vector<Neighbourhood> rows(n);
    tbb::parallel_for(tbb::blocked_range<int>(0, n, 128), [&](const tbb::blocked_range<int>& range) {
        const int begin = range.begin(), count = range.end() - range.begin();
        const RowMatrix products = embedding.middleRows(begin, count) * embedding.transpose();
        for (int r = 0; r < count; ++r)
            for (int i = 0; i < n; ++i) {
                const int k = begin + r;
                const double w = i == k ? 1.0 : 2 * products(r, i) / (kernel[k] + kernel[i]);
                if (w >= truncation) rows[k].emplace_back(i, w);
            }
    });
    return to_matrix(rows);
}

Hierarchy build_hierarchy(const Surface& surface, const Basis& basis, const HierarchyOptions& options) {
    const GeodesicGraph graph(surface.mesh);
    Hierarchy hierarchy{options, {}};
    append_diffusion_levels(hierarchy, surface, basis, graph, options);
    append_euclidean_levels(hierarchy, surface, graph, options);
    return hierarchy;
}

Level with_samples(const Level& level, const std::vector<int>& vertices, const Surface& surface,
                   const Basis& basis, const GeodesicGraph& graph, const HierarchyOptions& options) {
    std::vector<int> samples = level.samples;
    for (int v : vertices)
        if (level.samples[level.cell[v]] != v) samples.push_back(v);
    if (samples.size() == level.samples.size()) return level;
    const int count = int(samples.size());
    return level.kind == LevelKind::diffusion
               ? diffusion_level(level.scale, samples, count, surface, basis, graph, options)
               : sampled_euclidean_level(level.scale, samples, count, surface, graph, options);
}

std::vector<int> parents(const Level& fine, const Level& coarse) {
    std::vector<int> parent(fine.samples.size());
    for (size_t i = 0; i < parent.size(); ++i) parent[i] = coarse.cell[fine.samples[i]];
    return parent;
}

template <class Archive>
void serialize(Archive& archive, Level& level) {
    archive(level.kind, level.scale, level.samples, level.cell, level.mass, level.weights);
}
template <class Archive>
void serialize(Archive& archive, HierarchyOptions& o) {
    archive(o.truncation, o.density, o.growth, o.minimum_neighbours, o.full_neighbours, o.last_neighbours);
}
template <class Archive>
void serialize(Archive& archive, Hierarchy& hierarchy) {
    archive(hierarchy.options, hierarchy.levels);
}
std::string encode(const Hierarchy& hierarchy) {
    return cereal_encode(hierarchy);
}
void decode(const std::string& payload, Hierarchy& hierarchy) {
    cereal_decode(payload, hierarchy);
}

}  // namespace varimap
