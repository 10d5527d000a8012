#include "varimap/multilevel/reanchoring.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace varimap {

namespace {

constexpr double trusted_determinant = 0.3;  ///< anchors are oriented beyond doubt
constexpr int wanted_anchors = 24;
constexpr int least_anchors = 6;

/// Well-oriented samples around the part, nearest first.
std::vector<int> anchors_around(const ReversedPart& part, const LevelSide& from,
                                const Orientation& orientation, const GeodesicGraph& graph) {
    // Distance from the part: grown from each of its samples, keeping the smallest.
    std::vector<double> distance(from.level.samples.size(), std::numeric_limits<double>::infinity());
    std::vector<char> inside(from.level.samples.size(), 0);
    for (int k : part.samples) inside[k] = 1;
    std::vector<int> sample_at(graph.vertex_count(), -1);
    for (size_t k = 0; k < from.level.samples.size(); ++k) sample_at[from.level.samples[k]] = int(k);
    GeodesicBall ball(graph);
    for (int k : part.samples) {
        int found = 0;
        ball.grow(from.level.samples[k], [&](int v, double d) {
            const int s = sample_at[v];
            if (s < 0 || inside[s] || orientation.determinant[s] < trusted_determinant) return true;
            distance[s] = std::min(distance[s], d);
            return ++found < wanted_anchors;
        });
    }
    std::vector<int> anchors;
    for (size_t s = 0; s < distance.size(); ++s)
        if (std::isfinite(distance[s])) anchors.push_back(int(s));
    std::stable_sort(anchors.begin(), anchors.end(), [&](int a, int b) { return distance[a] < distance[b]; });
    if (int(anchors.size()) > wanted_anchors) anchors.resize(wanted_anchors);
    return anchors;
}

/// Distances from each of the vertices `sources` (rows) to the samples of a level (columns), up to a radius;
/// further samples get twice the radius.
RowMatrix distances_to_samples(const std::vector<int>& sources, const Level& level,
                               const GeodesicGraph& graph, double radius) {
    std::vector<int> sample_at(graph.vertex_count(), -1);
    for (size_t k = 0; k < level.samples.size(); ++k) sample_at[level.samples[k]] = int(k);
    RowMatrix distances = RowMatrix::Constant(sources.size(), level.samples.size(), 2 * radius);
    GeodesicBall ball(graph);
    for (size_t r = 0; r < sources.size(); ++r)
        ball.grow(sources[r], [&](int v, double d) {
            if (sample_at[v] >= 0) distances(r, sample_at[v]) = d;
            return d <= radius;
        });
    return distances;
}

/// Distances from each of the vertices `sources` (rows) to the part's samples (columns).
RowMatrix distances_to_part(const std::vector<int>& sources, const ReversedPart& part, const Level& level,
                            const GeodesicGraph& graph) {
    std::vector<int> column_at(graph.vertex_count(), -1);
    for (size_t n = 0; n < part.samples.size(); ++n) column_at[level.samples[part.samples[n]]] = int(n);
    RowMatrix distances(sources.size(), part.samples.size());
    GeodesicBall ball(graph);
    for (size_t r = 0; r < sources.size(); ++r) {
        size_t missing = part.samples.size();
        ball.grow(sources[r], [&](int v, double d) {
            if (column_at[v] >= 0) distances(r, column_at[v]) = d, --missing;
            return missing > 0;
        });
    }
    return distances;
}

}  // namespace

std::vector<ReversedPart> reversed_parts(const LevelSide& side, const Orientation& orientation,
                                         double minimum_mass) {
    std::vector<ReversedPart> parts;
    std::vector<char> seen(orientation.determinant.size(), 0);
    for (size_t seed = 0; seed < seen.size(); ++seed) {
        if (seen[seed] || orientation.determinant[seed] >= 0) continue;
        ReversedPart part;
        part.samples.push_back(int(seed));
        seen[seed] = 1;
        for (size_t head = 0; head < part.samples.size(); ++head) {
            part.mass += side.side.mass[part.samples[head]];
            for (SparseMatrix::InnerIterator it(side.side.reach, part.samples[head]); it; ++it)
                if (!seen[it.col()] && orientation.determinant[it.col()] < 0) {
                    seen[it.col()] = 1;
                    part.samples.push_back(int(it.col()));
                }
        }
        if (part.mass >= minimum_mass) parts.push_back(std::move(part));
    }
    std::stable_sort(parts.begin(), parts.end(),
                     [](const auto& a, const auto& b) { return a.mass > b.mass; });
    return parts;
}

std::vector<int> reanchored_images(const ReversedPart& part, const LevelSide& from,
                                   const Orientation& orientation, const GeodesicGraph& graph_from,
                                   const LevelSide& to, const GeodesicGraph& graph_to) {
    const std::vector<int> anchors = anchors_around(part, from, orientation, graph_from);
    if (int(anchors.size()) < least_anchors) return {};
    std::vector<int> here, there;
    for (int a : anchors) {
        here.push_back(from.level.samples[a]);
        there.push_back(orientation.image_vertex[a]);
    }
    const RowMatrix from_anchors = distances_to_part(here, part, from.level, graph_from);
    // Images may be somewhat further from the anchors' images than the samples are from the anchors.
    const RowMatrix from_images =
        distances_to_samples(there, to.level, graph_to, 1.3 * from_anchors.maxCoeff());
    std::vector<int> images;
    for (Eigen::Index n = 0; n < from_anchors.cols(); ++n) {
        Eigen::Index best;
        (from_images.colwise() - from_anchors.col(n)).colwise().squaredNorm().minCoeff(&best);
        images.push_back(int(best));
    }
    return images;
}

}  // namespace varimap
