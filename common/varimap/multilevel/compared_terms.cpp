#include "varimap/multilevel/compared_terms.h"

#include <cmath>

#include "varimap/spectral/local_shape.h"

namespace varimap {

namespace {

double variance(const RowMatrix& points, const Eigen::VectorXd& mass) {
    const Eigen::RowVectorXd mean = mass.transpose() * points;
    return mass.dot(Eigen::VectorXd((points.rowwise() - mean).rowwise().squaredNorm()));
}

/// Mean variance of a side's own neighbourhoods, in its own embedding.
double neighbourhood_variance(const Side& side) {
    const Eigen::VectorXd squares = side.averaging * Eigen::VectorXd(side.points.rowwise().squaredNorm());
    return side.mass.dot(squares - Eigen::VectorXd((side.averaging * side.points).rowwise().squaredNorm()));
}

void append(Side& side, const RowMatrix& columns) {
    RowMatrix all(columns.rows(), side.compared.cols() + columns.cols());
    if (side.compared.cols() > 0) all.leftCols(side.compared.cols()) = side.compared;
    all.rightCols(columns.cols()) = columns;
    side.compared = std::move(all);
}

RowMatrix cell_means(const LevelSide& side, const RowMatrix& features) {
    RowMatrix mean = RowMatrix::Zero(side.side.mass.size(), features.cols());
    for (size_t v = 0; v < side.level.cell.size(); ++v)
        mean.row(side.level.cell[v]) += side.vertex_mass[v] * features.row(v);
    return side.side.mass.cwiseInverse().asDiagonal() * mean;
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

FeatureTerm::FeatureTerm(const PairContext& context, double weight) : weight_(weight) {
    if (weight == 0) return;
    features_A_ = local_shape(context.A());
    features_B_ = local_shape(context.B());
}

void FeatureTerm::add_to(LevelPair& pair) const {
    if (weight_ == 0) return;
    const double scale =
        std::sqrt(weight_ * (neighbourhood_variance(pair.A.side) + neighbourhood_variance(pair.B.side)));
    append(pair.A.side, scale * cell_means(pair.A, features_A_));
    append(pair.B.side, scale * cell_means(pair.B, features_B_));
}

}  // namespace varimap
