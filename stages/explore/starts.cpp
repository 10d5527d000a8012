#include "stages/explore/starts.h"

#include <algorithm>
#include <array>

#include "stages/explore/principal_axes.h"

namespace varimap {

namespace {

/// The first eigenfunctions that are not constant, at the samples.
RowMatrix low_functions(const SurfaceData& data, const Level& level, Eigen::Index count) {
    return data.basis.functions(level.samples, Eigen::seqN(1, count));
}

int nearest_row(const RowMatrix& points, const Eigen::RowVectorXd& point) {
    int nearest;
    (points.rowwise() - point).rowwise().squaredNorm().minCoeff(&nearest);
    return nearest;
}

/// The same permutation for the same state on every platform, which std::shuffle does not promise.
std::vector<int> random_permutation(int count, std::mt19937& random) {
    std::vector<int> order(count);
    for (int i = 0; i < count; ++i) {
        const int j = int(random() % unsigned(i + 1));
        order[i] = order[j];
        order[j] = i;
    }
    return order;
}

/// Samples x 6: places along the principal axes, in deviations, and normals in the same frame.
RowMatrix places_along_axes(const Surface& surface, const std::vector<int>& samples) {
    constexpr double normal_weight = 0.5;
    const PrincipalAxes principal = principal_axes(surface);
    const Points normals = vertex_normals(surface.mesh);
    RowMatrix places(samples.size(), 6);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const Eigen::RowVector3d x = surface.mesh.vertices.row(samples[i]), n = normals.row(samples[i]);
        places.row(Eigen::Index(i)) << (x * principal.axes).cwiseQuotient(principal.deviation.transpose()),
            normal_weight * n * principal.axes;
    }
    return places;
}

/// The 24 rotations that lay coordinate axes onto coordinate axes.
std::vector<Eigen::Matrix3d> axis_rotations() {
    std::vector<Eigen::Matrix3d> rotations;
    std::array<int, 3> order{0, 1, 2};
    do {
        for (int signs = 0; signs < 8; ++signs) {
            Eigen::Matrix3d rotation = Eigen::Matrix3d::Zero();
            for (int k = 0; k < 3; ++k) rotation(k, order[std::size_t(k)]) = signs >> k & 1 ? -1 : 1;
            if (rotation.determinant() > 0) rotations.push_back(rotation);
        }
    } while (std::next_permutation(order.begin(), order.end()));
    return rotations;
}

Coupling swap_rows(const Coupling& plan, int first, int second) {
    Coupling swapped = plan;
    const int columns = plan.support.columns();
    for (int j = 0; j < columns; ++j)
        std::swap(swapped.value[first * columns + j], swapped.value[second * columns + j]);
    return swapped;
}

}  // namespace

Matching nearest_to_each_other(const RowMatrix& a, const RowMatrix& b) {
    Matching matching;
    for (int i = 0; i < a.rows(); ++i) matching.emplace_back(i, nearest_row(b, a.row(i)));
    for (int j = 0; j < b.rows(); ++j) matching.emplace_back(nearest_row(a, b.row(j)), j);
    return matching;
}

std::vector<Matching> spectral_matchings(const PairContext& context, const LevelPair& pair) {
    const Eigen::Index functions = std::min<Eigen::Index>(
        {4, context.A().basis.functions.cols() - 1, context.B().basis.functions.cols() - 1});
    const RowMatrix a = low_functions(context.A(), pair.A.level, functions);
    const RowMatrix b = low_functions(context.B(), pair.B.level, functions);
    std::vector<Matching> matchings;
    for (int signs = 0; signs < 1 << functions; ++signs) {
        Eigen::VectorXd factor(functions);
        for (Eigen::Index k = 0; k < functions; ++k) factor[k] = signs >> k & 1 ? -1 : 1;
        matchings.push_back(nearest_to_each_other(a * factor.asDiagonal(), b));
    }
    return matchings;
}

std::vector<Matching> axes_matchings(const PairContext& context, const LevelPair& pair) {
    const RowMatrix a = places_along_axes(context.A().surface, pair.A.level.samples),
                    b = places_along_axes(context.B().surface, pair.B.level.samples);
    std::vector<Matching> matchings;
    for (const Eigen::Matrix3d& rotation : axis_rotations()) {
        RowMatrix turned(a.rows(), a.cols());
        turned << a.leftCols<3>() * rotation, a.rightCols<3>() * rotation;
        matchings.push_back(nearest_to_each_other(turned, b));
    }
    return matchings;
}

std::vector<Matching> random_matchings(int rows, int columns, int count, std::mt19937& random) {
    std::vector<Matching> matchings(count);
    for (Matching& matching : matchings) {
        const std::vector<int> row = random_permutation(rows, random),
                               column = random_permutation(columns, random);
        for (int n = 0; n < std::max(rows, columns); ++n)
            matching.emplace_back(row[n % rows], column[n % columns]);
    }
    return matchings;
}

Coupling coarsened(const Coupling& plan, const LevelPair& fine, const Levels& coarse) {
    const auto row = parents(fine.A.level, coarse.A), column = parents(fine.B.level, coarse.B);
    const int rows = int(coarse.A.samples.size()), columns = int(coarse.B.samples.size());
    Coupling sum{Support::dense(rows, columns), Eigen::VectorXd::Zero(Eigen::Index(rows) * columns),
                 Eigen::VectorXd::Zero(rows), Eigen::VectorXd::Zero(columns)};
    for (int i = 0; i < plan.support.rows(); ++i)
        for (int e = plan.support.row_begin[i]; e < plan.support.row_begin[i + 1]; ++e)
            sum.value[row[i] * columns + column[plan.support.column[e]]] += plan.value[e];
    return sum;
}

std::vector<Coupling> with_swapped_rows(const Coupling& plan, int count) {
    count = std::min(count, plan.support.rows());
    std::vector<Coupling> swapped;
    for (int first = 0; first < count; ++first)
        for (int second = first + 1; second < count; ++second)
            swapped.push_back(swap_rows(plan, first, second));
    return swapped;
}

}  // namespace varimap
