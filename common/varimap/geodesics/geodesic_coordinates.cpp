#include "varimap/geodesics/geodesic_coordinates.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace varimap {

namespace {

/// Squared distances, points x far ones: each of these is the farthest from those before it, the first from
/// point 0.
RowMatrix squared_distances_to_far_points(const GeodesicGraph& graph, std::vector<int>& far) {
    constexpr int most_far = 500;
    const int points = graph.vertex_count(), count = std::min(points, most_far);
    RowMatrix squared(points, count);
    GeodesicBall ball(graph);
    Eigen::VectorXd nearest = Eigen::VectorXd::Constant(points, std::numeric_limits<double>::infinity());
    Eigen::Index next = 0;
    ball.grow(0, [&](int v, double) { return next = v, true; });
    for (int k = 0; k < count; ++k) {
        far.push_back(int(next));
        ball.grow(far.back(), [&](int v, double d) { return squared(v, k) = d * d, true; });
        nearest = nearest.cwiseMin(squared.col(k));
        nearest.maxCoeff(&next);
    }
    return squared;
}

}  // namespace

RowMatrix geodesic_coordinates(const GeodesicGraph& graph, int dimensions) {
    std::vector<int> far;
    const RowMatrix squared = squared_distances_to_far_points(graph, far);
    const RowMatrix among = squared(far, Eigen::all);
    const Eigen::RowVectorXd mean = among.colwise().mean();
    Eigen::MatrixXd products = -0.5 * ((among.rowwise() - mean).colwise() - mean.transpose());
    products.array() -= 0.5 * mean.mean();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver((products + products.transpose()) / 2);
    const Eigen::VectorXd& values = solver.eigenvalues();  // ascending
    const double least = 1e-9 * values.maxCoeff();
    const auto positive = (values.array() > least).count();
    const Eigen::Index count = std::min<Eigen::Index>(dimensions, positive);
    const Eigen::MatrixXd axes = solver.eigenvectors().rightCols(count).rowwise().reverse();
    const Eigen::VectorXd roots = values.tail(count).reverse().cwiseSqrt();
    return -0.5 * (squared.rowwise() - mean) * axes * roots.cwiseInverse().asDiagonal();
}

}  // namespace varimap
