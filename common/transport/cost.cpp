#include "common/transport/cost.h"

#include "common/stage/parallel.h"

namespace varimap {

namespace {

/// The points with a last column of their squared norms.
RowMatrix with_squared_norms(const RowMatrix& points) {
    RowMatrix extended(points.rows(), points.cols() + 1);
    extended << points, points.rowwise().squaredNorm();
    return extended;
}

/// A = diag(1/m) P' diag(m): a_ik = m_k W_k(x_i) / Z_k.
SparseMatrix cost_weights(const Side& side) {
    return side.mass.cwiseInverse().asDiagonal() * SparseMatrix(side.averaging.transpose()) * side.mass.asDiagonal();
}

/// What one side's centres contribute to a cost entry: sum_k a_ik |z - eta_k|^2 = alpha_i |z|^2 - 2 z . g_i + c_i.
struct CollapsedSum {
    RowMatrix g;
    Eigen::VectorXd alpha, c;

    CollapsedSum(const Side& side, const RowMatrix& centres) {
        const SparseMatrix A = cost_weights(side);
        g = A * centres;
        alpha = A * Eigen::VectorXd::Ones(side.mass.size());
        c = A * Eigen::VectorXd(centres.rowwise().squaredNorm());
    }
};

void pin(const Side& side, const Side& other, RowMatrix& centres) {
    for (size_t k = 0; k < side.partner.size(); ++k)
        if (side.partner[k] >= 0) centres.row(k) = other.points.row(side.partner[k]);
}

/// sum_k m_k var[image of the k-th neighbourhood, eta_k]; `image` has squared norms in its last column.
double side_energy(const Side& side, const RowMatrix& image, const RowMatrix& centres) {
    const RowMatrix mean = side.averaging * image;
    const Eigen::Index D = centres.cols();
    const Eigen::VectorXd variance = mean.col(D) - 2 * mean.leftCols(D).cwiseProduct(centres).rowwise().sum() +
                                     centres.rowwise().squaredNorm();
    return side.mass.dot(variance);
}

}  // namespace

SparseMatrix averaging_operator(const SparseMatrix& weights, const Eigen::VectorXd& mass) {
    SparseMatrix P = weights * mass.asDiagonal();
    for (int k = 0; k < P.outerSize(); ++k) {
        double total = 0;
        for (SparseMatrix::InnerIterator it(P, k); it; ++it) total += it.value();
        for (SparseMatrix::InnerIterator it(P, k); it; ++it) it.valueRef() /= total;
    }
    return P;
}

void pin_landmarks(const Side& X, const Side& Y, Centres& centres) {
    pin(X, Y, centres.row);
    pin(Y, X, centres.column);
}

CostFactors::CostFactors(const Side& X, const Side& Y, const Centres& centres) {
    const CollapsedSum x(X, centres.row), y(Y, centres.column);
    const Eigen::Index DX = X.points.cols(), DY = Y.points.cols();
    const bool aligned = X.aligned.size() > 0;
    const Eigen::Index columns = DX + DY + 4 + (aligned ? 5 : 0);
    u_.resize(X.points.rows(), columns);
    v_.resize(Y.points.rows(), columns);
    const Eigen::VectorXd one_x = Eigen::VectorXd::Ones(u_.rows()), one_y = Eigen::VectorXd::Ones(v_.rows());
    u_.leftCols(DX + DY + 4) << -2 * x.g, X.points, x.alpha, X.points.rowwise().squaredNorm(), x.c, one_x;
    v_.leftCols(DX + DY + 4) << Y.points, -2 * y.g, Y.points.rowwise().squaredNorm(), y.alpha, one_y, y.c;
    if (!aligned) return;
    u_.rightCols(5) << -2 * X.aligned, X.aligned.rowwise().squaredNorm(), one_x;
    v_.rightCols(5) << Y.aligned, one_y, Y.aligned.rowwise().squaredNorm();
}

Eigen::VectorXd CostFactors::on(const Support& support) const {
    Eigen::VectorXd cost(support.entries());
    parallel_for_each_index(0 + support.rows(), 32, [&](int i) {
        for (int e = support.row_begin[i]; e < support.row_begin[i + 1]; ++e)
            cost[e] = std::max(0.0, entry(i, support.column[e]));
    });
    return cost;
}

CentreStep update_centres(const Side& X, const Side& Y, const Coupling& plan) {
    const RowMatrix row_image = row_barycentres(plan, with_squared_norms(Y.points));
    const RowMatrix column_image = column_barycentres(plan, with_squared_norms(X.points));
    CentreStep step;
    step.row_image = row_image.leftCols(Y.points.cols());
    step.column_image = column_image.leftCols(X.points.cols());
    step.centres = {X.averaging * step.row_image, Y.averaging * step.column_image};
    pin_landmarks(X, Y, step.centres);
    step.energy = side_energy(X, row_image, step.centres.row) + side_energy(Y, column_image, step.centres.column);
    return step;
}

double energy(const Side& X, const Side& Y, const Coupling& plan, const Centres& centres) {
    return side_energy(X, row_barycentres(plan, with_squared_norms(Y.points)), centres.row) +
           side_energy(Y, column_barycentres(plan, with_squared_norms(X.points)), centres.column);
}

}  // namespace varimap
