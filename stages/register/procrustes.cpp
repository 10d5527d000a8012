#include "stages/register/procrustes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "varimap/core/rotation.h"
#include "varimap/core/statistics.h"

namespace varimap {
namespace {

Eigen::RowVector3d centroid(const Points& points, const Eigen::VectorXd& weights) {
    return weights.transpose() * points;
}

/// Root mean square of the rows' lengths.
double size_of(const Points& points, const Eigen::VectorXd& weights) {
    return std::sqrt(weights.dot(Eigen::VectorXd(points.rowwise().squaredNorm())));
}

/// The rotation R for which the rows of points * R are nearest to those of `onto` (Kabsch 1976).
Eigen::Matrix3d best_rotation(const Points& points, const Points& onto, const Eigen::VectorXd& weights) {
    return nearest_rotation(points.transpose() * weights.asDiagonal() * onto);
}

Points average(const std::vector<Points>& shapes) {
    Points sum = Points::Zero(shapes.front().rows(), 3);
    for (const Points& shape : shapes) sum += shape;
    return sum / double(shapes.size());
}

void turn_onto(const Points& mean, std::vector<Points>& shapes, const Eigen::VectorXd& weights) {
    for (Points& shape : shapes) shape = (shape * best_rotation(shape, mean, weights)).eval();
}

}  // namespace

double size_about_centroid(const Points& points, const Eigen::VectorXd& weights) {
    return size_of(points.rowwise() - centroid(points, weights), weights);
}

LaidOver laid_over(const Points& points, const Points& onto, const Eigen::VectorXd& weights, bool scale) {
    const Eigen::RowVector3d place = centroid(onto, weights);
    const Points there = onto.rowwise() - place;
    Points shape = points.rowwise() - centroid(points, weights);
    const double ratio = size_of(shape, weights) / size_of(there, weights);
    if (scale) shape /= ratio;
    shape = ((shape * best_rotation(shape, there, weights)).rowwise() + place).eval();
    const double distance = size_of(shape - onto, weights);
    return {std::move(shape), ratio, distance};
}

Alignment procrustes(const std::vector<Points>& shapes, const Points& start, const Eigen::VectorXd& weights,
                     bool scale) {
    Alignment result;
    double mean_size = 0;
    for (const Points& shape : shapes) {
        result.shapes.push_back(shape.rowwise() - centroid(shape, weights));
        result.sizes.push_back(size_of(result.shapes.back(), weights));
        mean_size += result.sizes.back() / double(shapes.size());
    }
    for (std::size_t i = 0; scale && i < shapes.size(); ++i) result.shapes[i] *= mean_size / result.sizes[i];
    const Eigen::RowVector3d place = centroid(start, weights);
    const Points upright = start.rowwise() - place;
    result.mean = upright;
    for (int iteration = 0; iteration < 100; ++iteration) {
        turn_onto(result.mean, result.shapes, weights);
        Points mean = average(result.shapes);
        if (scale) mean *= mean_size / size_of(mean, weights);
        const double change = size_of(mean - result.mean, weights);
        result.mean = std::move(mean);
        if (change <= 1e-12 * mean_size) break;
    }
    // The iteration leaves the direction of the mean open: it is that of `start`.
    const Eigen::Matrix3d back = best_rotation(result.mean, upright, weights);
    result.mean = ((result.mean * back).rowwise() + place).eval();
    for (Points& shape : result.shapes) {
        shape = ((shape * back).rowwise() + place).eval();
        result.distances.push_back(size_of(shape - result.mean, weights));
    }
    return result;
}

PrincipalComponents principal_components(const Alignment& alignment, const Eigen::VectorXd& weights,
                                         int count) {
    const auto shapes = Eigen::Index(alignment.shapes.size());
    PrincipalComponents result;
    if (shapes < 2) return result;
    const Points centre = average(alignment.shapes);
    Eigen::MatrixXd gram(shapes, shapes);
    for (Eigen::Index i = 0; i < shapes; ++i)
        for (Eigen::Index j = 0; j <= i; ++j)
            gram(i, j) = gram(j, i) =
                weights.dot(Eigen::VectorXd((alignment.shapes[std::size_t(i)] - centre)
                                                .cwiseProduct(alignment.shapes[std::size_t(j)] - centre)
                                                .rowwise()
                                                .sum()));
    const double degrees = double(shapes - 1);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram / degrees);
    const Eigen::Index kept = std::min<Eigen::Index>(count, shapes - 1);
    result.total_variance = gram.trace() / degrees;
    result.variance.resize(kept);
    result.scores.resize(shapes, kept);
    for (Eigen::Index k = 0; k < kept; ++k) {
        Eigen::VectorXd vector = solver.eigenvectors().col(shapes - 1 - k);
        Eigen::Index largest;
        vector.cwiseAbs().maxCoeff(&largest);
        if (vector[largest] < 0) vector = -vector;
        result.variance[k] = std::max(0., solver.eigenvalues()[shapes - 1 - k]);
        result.scores.col(k) = std::sqrt(degrees * result.variance[k]) * vector;
        Points displacement = Points::Zero(centre.rows(), 3);
        for (Eigen::Index i = 0; i < shapes; ++i)
            displacement += vector[i] / std::sqrt(degrees) * (alignment.shapes[std::size_t(i)] - centre);
        result.displacement.push_back(std::move(displacement));
    }
    return result;
}

std::vector<bool> outliers(const std::vector<double>& distances, double resolution) {
    std::vector<bool> found(distances.size(), false);
    if (distances.size() < 5) return found;
    const Eigen::VectorXd values = Eigen::VectorXd::Map(distances.data(), Eigen::Index(distances.size()));
    const double middle = upper_median(values);
    const double spread = 3 * 1.4826 * upper_median((values.array() - middle).abs());
    for (std::size_t i = 0; i < distances.size(); ++i)
        found[i] = distances[i] > middle + std::max(spread, resolution);
    return found;
}

}  // namespace varimap
