#include "varimap/spectral/neighbourhoods.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "varimap/core/parallel.h"

namespace varimap {

namespace {

using Neighbourhood = std::vector<std::pair<int, double>>;  ///< sample; distance, or weight

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

/// Those of a matrix, of which there may be more than it has.
std::vector<Neighbourhood> rows_of(const SparseMatrix& matrix, std::size_t count) {
    std::vector<Neighbourhood> rows(count);
    for (int k = 0; k < int(matrix.rows()); ++k)
        for (SparseMatrix::InnerIterator it(matrix, k); it; ++it)
            rows[size_t(k)].emplace_back(int(it.col()), it.value());
    return rows;
}

/// Samples of a domain as the balls around them see each other.
struct BallSamples {
    const std::vector<int>& samples;
    std::vector<int> index;  ///< per vertex: its number among the samples, or -1
    Points normals;          ///< per vertex of a surface

    BallSamples(const std::vector<int>& all, const Domain& domain)
        : samples(all), index(domain.mass.size(), -1) {
        if (domain.is_surface()) normals = vertex_normals(domain.mesh);
        for (size_t k = 0; k < samples.size(); ++k) index[samples[k]] = int(k);
    }
    bool normals_agree(int v, int w) const {
        return v == w || normals.rows() == 0 || normals.row(v).dot(normals.row(w)) > 0;
    }
};

/// The ball around a sample: its members with their weights, sorted.
Neighbourhood ball_around(int sample, const BallSamples& all, const BallRule& rule, GeodesicBall& ball) {
    Neighbourhood members;
    double radius = rule.radius;
    const int least = std::min<int>(rule.minimum_neighbours, int(all.samples.size()));
    ball.grow(sample, [&](int v, double d) {
        if (d > radius * (1 + 1e-9) && int(members.size()) >= least) return false;
        if (all.index[v] < 0) return true;
        if (int(members.size()) < least) radius = std::max(radius, d);
        if (all.normals_agree(v, sample)) members.emplace_back(all.index[v], d);
        return true;
    });
    const double sigma = radius / gaussian_distance(rule.truncation);
    for (auto& [i, d] : members) d = sigma > 0 ? std::exp(-d * d / (2 * sigma * sigma)) : 1.0;
    std::sort(members.begin(), members.end());
    return members;
}

/// Geodesic distance from a sample to the farthest member of its neighbourhood. `wanted` (per vertex) is all
/// zero before and after.
double radius_of(int k, const std::vector<int>& samples, const SparseMatrix& weights, GeodesicBall& ball,
                 std::vector<char>& wanted) {
    double radius = 0;
    int missing = 0;
    for (SparseMatrix::InnerIterator it(weights, k); it; ++it, ++missing) wanted[samples[it.col()]] = 1;
    ball.grow(samples[k], [&](int v, double d) {
        if (wanted[v]) radius = d, wanted[v] = 0, --missing;
        return missing > 0;
    });
    for (SparseMatrix::InnerIterator it(weights, k); it; ++it) wanted[samples[it.col()]] = 0;
    return radius;
}

}  // namespace

double gaussian_distance(double weight) {
    return std::sqrt(-2 * std::log(weight));
}

SparseMatrix diffusion_weights(const RowMatrix& embedding, double truncation) {
    // Always the same rows at a time: in a product of other rows the last digits of its entries differ.
    constexpr int block = 128;
    const int n = int(embedding.rows());
    const Eigen::VectorXd kernel = embedding.rowwise().squaredNorm();
    std::vector<Neighbourhood> rows(n);
    parallel_for_each_index((n + block - 1) / block, 1, [&](int b) {
        const int begin = b * block, count = std::min(block, n - begin);
        const RowMatrix products = embedding.middleRows(begin, count) * embedding.transpose();
        for (int r = 0; r < count; ++r)
            for (int i = 0; i < n; ++i) {
                const int k = begin + r;
                const double w = i == k ? 1.0 : diffusion_weight(products(r, i), kernel[k], kernel[i]);
                if (w >= truncation) rows[k].emplace_back(i, w);
            }
    });
    return to_matrix(rows);
}

SparseMatrix more_diffusion_weights(const SparseMatrix& weights, const RowMatrix& embedding,
                                    double truncation) {
    const int known = int(weights.rows()), n = int(embedding.rows());
    std::vector<Neighbourhood> rows = rows_of(weights, size_t(n));
    const Eigen::VectorXd kernel = embedding.rowwise().squaredNorm();
    for (int k = known; k < n; ++k) {
        const Eigen::VectorXd products = embedding * embedding.row(k).transpose();
        for (int i = 0; i < n; ++i) {
            const double w = i == k ? 1.0 : diffusion_weight(products[i], kernel[k], kernel[i]);
            if (w < truncation) continue;
            rows[size_t(k)].emplace_back(i, w);
            if (i < known) rows[size_t(i)].emplace_back(k, w);
        }
    }
    return to_matrix(rows);
}

namespace {

/// Anew, those samples for which `wanted` is true.
void grow_balls(const BallSamples& all, const std::vector<bool>& wanted, const GeodesicGraph& graph,
                const BallRule& rule, std::vector<Neighbourhood>& rows) {
    parallel_for_each_range(rows.size(), 256, [&](std::size_t begin, std::size_t end) {
        GeodesicBall ball(graph);
        for (std::size_t k = begin; k < end; ++k)
            if (wanted[k]) rows[k] = ball_around(all.samples[k], all, rule, ball);
    });
}

/// Of known neighbourhoods, those that further samples may belong to: those around them, and those whose
/// radius had to grow.
std::vector<bool> may_change(const std::vector<Neighbourhood>& rows, std::size_t known,
                             const BallSamples& all, const GeodesicGraph& graph, const BallRule& rule) {
    std::vector<bool> may(rows.size(), false);
    for (std::size_t k = 0; k < rows.size(); ++k) {
        double least = 1;
        for (const auto& [i, w] : rows[k]) least = std::min(least, w);
        may[k] = int(rows[k].size()) <= rule.minimum_neighbours || least <= rule.truncation * (1 + 1e-6);
    }
    GeodesicBall ball(graph);
    for (std::size_t k = known; k < rows.size(); ++k)
        ball.grow(all.samples[k], [&](int v, double d) {
            if (d > rule.radius * (1 + 1e-6)) return false;
            if (all.index[size_t(v)] >= 0) may[size_t(all.index[size_t(v)])] = true;
            return true;
        });
    return may;
}

}  // namespace

SparseMatrix geodesic_weights(const std::vector<int>& samples, const Domain& domain,
                              const GeodesicGraph& graph, const BallRule& rule) {
    std::vector<Neighbourhood> rows(samples.size());
    grow_balls({samples, domain}, std::vector<bool>(samples.size(), true), graph, rule, rows);
    return to_matrix(rows);
}

SparseMatrix more_geodesic_weights(const SparseMatrix& weights, const std::vector<int>& samples,
                                   const Domain& domain, const GeodesicGraph& graph, const BallRule& rule) {
    const BallSamples all(samples, domain);
    std::vector<Neighbourhood> rows = rows_of(weights, samples.size());
    grow_balls(all, may_change(rows, size_t(weights.rows()), all, graph, rule), graph, rule, rows);
    return to_matrix(rows);
}

double average_radius(const std::vector<int>& samples, const SparseMatrix& weights,
                      const GeodesicGraph& graph) {
    std::vector<double> radius(samples.size());
    parallel_for_each_range(radius.size(), 32, [&](std::size_t begin, std::size_t end) {
        GeodesicBall ball(graph);
        std::vector<char> wanted(graph.vertex_count(), 0);
        for (std::size_t k = begin; k < end; ++k)
            radius[k] = radius_of(int(k), samples, weights, ball, wanted);
    });
    return std::accumulate(radius.begin(), radius.end(), 0.0) / double(radius.size());
}

SparseMatrix nearer_part(const SparseMatrix& weights, double truncation) {
    // W >= 0.7 where epsilon is 0.5: half of a Gaussian neighbourhood's area has W >= sqrt(epsilon). Chosen
    // by hand on the known pairs, not swept.
    const double exponent = std::log(0.7) / std::log(0.5);
    const double least = std::pow(truncation, exponent);
    SparseMatrix near = weights;
    near.prune([least](Eigen::Index, Eigen::Index, double w) { return w >= least; });
    return near;
}

}  // namespace varimap
