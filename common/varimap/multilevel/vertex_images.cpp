#include "varimap/multilevel/vertex_images.h"

#include <algorithm>

#include "varimap/core/parallel.h"
#include "varimap/multilevel/orientation.h"
#include "varimap/spectral/neighbourhoods.h"
#include "varimap/transport/support.h"

namespace varimap {

namespace {

/// Mean of values of the samples over a vertex's own neighbourhood, among the samples of its cell's
/// neighbourhood; no entries where none has any weight.
Eigen::RowVectorXd neighbourhood_mean(int vertex, const LevelSide& from, const RowMatrix& value) {
    const int k = from.level.cell[size_t(vertex)];
    const auto here = from.vertex_points.row(vertex);
    Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(value.cols());
    double total = 0;
    for (SparseMatrix::InnerIterator it(from.side.weights, k); it; ++it) {
        const auto there = from.side.points.row(it.col());
        const double w = diffusion_weight(here.dot(there), here.squaredNorm(), there.squaredNorm());
        if (w < from.truncation && it.col() != k) continue;
        total += from.side.mass[it.col()] * std::max(w, 0.0);
        sum += from.side.mass[it.col()] * std::max(w, 0.0) * value.row(it.col());
    }
    if (!(total > 0)) return {};
    return sum / total;
}

}  // namespace

std::vector<int> vertex_images(const LevelSide& from, const LevelSide& to, const RowMatrix& sample_image,
                               const std::vector<int>& partner, const GeodesicGraph& target_graph) {
    std::vector<int> images(from.level.cell.size());
    parallel_for_each_index(images.size(), size_t(64), [&](size_t v) {
        const int start = to.level.samples[size_t(partner[size_t(from.level.cell[v])])];
        const Eigen::RowVectorXd centre = neighbourhood_mean(int(v), from, sample_image);
        images[v] =
            centre.size() > 0 ? nearest_by_descent(start, centre, to.vertex_points, target_graph) : start;
    });
    return images;
}

VertexImages vertex_images(const Solution& solution, const LevelPair& pair, const PairContext& context) {
    return {vertex_images(pair.A, pair.B, solution.step.row_image, largest_of_rows(solution.plan),
                          context.graph_B()),
            vertex_images(pair.B, pair.A, solution.step.column_image, largest_of_columns(solution.plan),
                          context.graph_A())};
}

}  // namespace varimap
