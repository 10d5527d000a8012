#include "varimap/multilevel/reanchoring.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "varimap/core/index_set.h"

namespace varimap {

namespace {

// Chosen by hand on the known pairs, not swept.
constexpr double trusted_determinant = 0.3;  ///< anchors are oriented beyond doubt
constexpr int wanted_anchors = 12;
constexpr int least_anchors = 6;
/// Images may be somewhat further from the anchors' images than the samples are from the anchors.
constexpr double stretch = 1.3;

/// Per vertex: the number of the sample that it is, among these samples of a level; or -1.
std::vector<int> numbers_at_vertices(const std::vector<int>& samples, const LevelSide& side) {
    std::vector<int> number(side.level.cell.size(), -1);
    for (size_t n = 0; n < samples.size(); ++n) number[side.level.samples[samples[n]]] = int(n);
    return number;
}

std::vector<int> all_samples(const LevelSide& side) {
    return all_indices(std::ssize(side.level.samples));
}

/// Well-oriented samples around the part, nearest first, as many as are wanted.
std::vector<int> anchors_around(const ReversedPart& part, const GraphedSide& from,
                                const Orientation& orientation) {
    const std::vector<int>& samples = from.level_side.level.samples;
    const std::vector<int> sample_at = numbers_at_vertices(all_samples(from.level_side), from.level_side);
    std::vector<char> inside(samples.size(), 0);
    std::vector<int> sources, anchors;
    for (const int k : part.samples) {
        inside[k] = 1;
        sources.push_back(samples[k]);
    }
    GeodesicBall(from.graph).grow(sources, [&](int v, double) {
        const int s = sample_at[v];
        if (s >= 0 && !inside[s] && orientation.determinant[s] >= trusted_determinant) anchors.push_back(s);
        return int(anchors.size()) < wanted_anchors;
    });
    return anchors;
}

/// Distances from each of the vertices `sources` (rows) to all samples of a side (columns), up to a radius;
/// further samples get twice the radius.
RowMatrix distances_to_samples(const std::vector<int>& sources, const GraphedSide& to, double radius) {
    const std::vector<int> sample_at = numbers_at_vertices(all_samples(to.level_side), to.level_side);
    RowMatrix distances = RowMatrix::Constant(sources.size(), to.level_side.level.samples.size(), 2 * radius);
    GeodesicBall ball(to.graph);
    for (size_t r = 0; r < sources.size(); ++r)
        ball.grow(sources[r], [&](int v, double d) {
            if (sample_at[v] >= 0) distances(r, sample_at[v]) = d;
            return d <= radius;
        });
    return distances;
}

/// Distances from each of the vertices `sources` (rows) to the part's samples (columns).
RowMatrix distances_to_part(const std::vector<int>& sources, const ReversedPart& part,
                            const GraphedSide& side) {
    const std::vector<int> column_at = numbers_at_vertices(part.samples, side.level_side);
    RowMatrix distances =
        RowMatrix::Constant(sources.size(), part.samples.size(), std::numeric_limits<double>::infinity());
    GeodesicBall ball(side.graph);
    for (size_t r = 0; r < sources.size(); ++r) {
        size_t missing = part.samples.size();
        ball.grow(sources[r], [&](int v, double d) {
            if (column_at[v] >= 0) distances(r, column_at[v]) = d, --missing;
            return missing > 0;
        });
    }
    return distances;
}

/// The connected patch of reversed samples that holds one; marks them as seen.
ReversedPart part_around(int seed, const LevelSide& side, const Orientation& orientation,
                         std::vector<char>& seen) {
    ReversedPart part;
    part.samples.push_back(seed);
    seen[seed] = 1;
    for (size_t head = 0; head < part.samples.size(); ++head) {
        part.mass += side.side.mass[part.samples[head]];
        for (SparseMatrix::InnerIterator it(side.side.neighbours, part.samples[head]); it; ++it)
            if (!seen[it.col()] && orientation.determinant[it.col()] < 0) {
                seen[it.col()] = 1;
                part.samples.push_back(int(it.col()));
            }
    }
    return part;
}

}  // namespace

std::vector<ReversedPart> reversed_parts(const LevelSide& side, const Orientation& orientation,
                                         double minimum_mass) {
    std::vector<ReversedPart> parts;
    std::vector<char> seen(orientation.determinant.size(), 0);
    for (size_t seed = 0; seed < seen.size(); ++seed) {
        if (seen[seed] || orientation.determinant[seed] >= 0) continue;
        ReversedPart part = part_around(int(seed), side, orientation, seen);
        if (part.mass >= minimum_mass) parts.push_back(std::move(part));
    }
    std::stable_sort(parts.begin(), parts.end(),
                     [](const auto& a, const auto& b) { return a.mass > b.mass; });
    return parts;
}

std::vector<int> reanchored_images(const ReversedPart& part, const Orientation& orientation,
                                   const GraphedSide& from, const GraphedSide& to) {
    const std::vector<int> anchors = anchors_around(part, from, orientation);
    if (int(anchors.size()) < least_anchors) return {};
    std::vector<int> here, there;
    for (int a : anchors) {
        here.push_back(from.level_side.level.samples[a]);
        there.push_back(orientation.image_vertex[a]);
    }
    const RowMatrix from_anchors = distances_to_part(here, part, from);
    const RowMatrix from_images = distances_to_samples(there, to, stretch * from_anchors.maxCoeff());
    std::vector<int> images;
    for (Eigen::Index n = 0; n < from_anchors.cols(); ++n) {
        Eigen::Index best;
        (from_images.colwise() - from_anchors.col(n)).colwise().squaredNorm().minCoeff(&best);
        images.push_back(int(best));
    }
    return images;
}

}  // namespace varimap
