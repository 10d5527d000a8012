#include "varimap/multilevel/descriptor_terms.h"

#include <cmath>

#include "varimap/core/statistics.h"

namespace varimap {

namespace {

/// Mean variance of a side's own neighbourhoods, in its own embedding.
double neighbourhood_variance(const Side& side) {
    const Eigen::VectorXd squares = side.averaging.P * Eigen::VectorXd(side.points.rowwise().squaredNorm());
    return side.mass.dot(squares - Eigen::VectorXd((side.averaging.P * side.points).rowwise().squaredNorm()));
}

void append(Side& side, const RowMatrix& columns) {
    RowMatrix all(columns.rows(), side.descriptor.cols() + columns.cols());
    if (side.descriptor.cols() > 0) all.leftCols(side.descriptor.cols()) = side.descriptor;
    all.rightCols(columns.cols()) = columns;
    side.descriptor = std::move(all);
}

/// What descriptors are multiplied by: a difference of 1 then costs as much as add_shape_term says.
double scale_of(const LevelPair& pair, double weight) {
    return std::sqrt(weight * (neighbourhood_variance(pair.A.side) + neighbourhood_variance(pair.B.side)));
}

/// `descriptors`: per vertex; samples have the means of their cells.
void append_means(LevelSide& side, const RowMatrix& descriptors, double scale) {
    append(side.side, scale * cell_means(side.level, side.vertex_mass, descriptors));
}

/// vertices x landmarks: exp(-d / reach) at a distance d along the surface.
RowMatrix nearness(const GeodesicGraph& graph, const std::vector<int>& landmarks) {
    // Units of sqrt(area). At 0.2 errors of half of the known pairs are 1.013 times those, and more is
    // reversed.
    constexpr double reach = 0.1;
    return (-distances_from_each(graph, landmarks).transpose().array() / reach).exp();
}

}  // namespace

void add_wasserstein_term(LevelPair& pair, const PairContext& context, double weight) {
    const RowMatrix a = sample_positions(context.A().surface, pair.A.level);
    const RowMatrix b = sample_positions(context.B().surface, pair.B.level);
    const double ratio =
        (variance(pair.A.side.points, pair.A.side.mass) + variance(pair.B.side.points, pair.B.side.mass)) /
        (variance(a, pair.A.side.mass) + variance(b, pair.B.side.mass));
    append(pair.A.side, std::sqrt(weight * ratio) * a);
    append(pair.B.side, std::sqrt(weight * ratio) * b);
}

void add_shape_term(LevelPair& pair, const PairContext& context, double weight) {
    if (weight == 0) return;
    const double scale = scale_of(pair, weight);
    append_means(pair.A, context.A().hierarchy.shape.descriptors, scale);
    append_means(pair.B, context.B().hierarchy.shape.descriptors, scale);
}

void add_landmark_term(LevelPair& pair, const PairContext& context, double weight) {
    if (weight == 0 || context.landmarks().empty() || !context.A().surface.is_surface()) return;
    const double scale = scale_of(pair, weight * context.landmark_weight());
    append_means(pair.A, nearness(context.graph_A(), context.landmarks_A()), scale);
    append_means(pair.B, nearness(context.graph_B(), context.landmarks_B()), scale);
}

void add_descriptor_terms(LevelPair& pair, const PairContext& context, const DescriptorWeights& weights) {
    add_shape_term(pair, context, weights.shape);
    add_landmark_term(pair, context, weights.vicinity);
}

}  // namespace varimap
