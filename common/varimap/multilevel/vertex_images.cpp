#include "varimap/multilevel/vertex_images.h"

#include <algorithm>

#include "varimap/core/parallel.h"
#include "varimap/multilevel/orientation.h"

namespace varimap {

namespace {

/// Column of the largest entry of each row.
std::vector<int> best_partners(const SparseMatrix& plan) {
    std::vector<int> best(plan.rows(), 0);
    for (int i = 0; i < plan.outerSize(); ++i) {
        double largest = -1;
        for (SparseMatrix::InnerIterator it(plan, i); it; ++it)
            if (it.value() > largest) largest = it.value(), best[i] = int(it.col());
    }
    return best;
}

}  // namespace

std::vector<int> vertex_images(const LevelSide& from, const LevelSide& to, const RowMatrix& sample_image,
                               const SparseMatrix& plan, const GeodesicGraph& target_graph) {
    const std::vector<int> best = best_partners(plan);
    std::vector<int> images(from.level.cell.size());
    parallel_for_each_index(images.size(), size_t(64), [&](size_t v) {
        const int k = from.level.cell[v];
        const auto here = from.vertex_points.row(v);
        // The vertex's own neighbourhood, among the samples of its cell's neighbourhood.
        Eigen::RowVectorXd centre = Eigen::RowVectorXd::Zero(sample_image.cols());
        double total = 0;
        for (SparseMatrix::InnerIterator it(from.side.weights, k); it; ++it) {
            const auto there = from.side.points.row(it.col());
            const double w = 2 * here.dot(there) / (here.squaredNorm() + there.squaredNorm());
            if (w < 0.5 && it.col() != k) continue;
            total += from.side.mass[it.col()] * std::max(w, 0.0);
            centre += from.side.mass[it.col()] * std::max(w, 0.0) * sample_image.row(it.col());
        }
        const int start = to.level.samples[best[k]];
        images[v] =
            total > 0 ? nearest_by_descent(start, centre / total, to.vertex_points, target_graph) : start;
    });
    return images;
}

}  // namespace varimap
