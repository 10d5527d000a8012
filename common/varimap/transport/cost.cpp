#include "varimap/transport/cost.h"

#include "varimap/core/parallel.h"

namespace varimap {

namespace {

/// The points with a last column of their squared norms.
RowMatrix with_squared_norms(const RowMatrix& points) {
    RowMatrix extended(points.rows(), points.cols() + 1);
    extended << points, points.rowwise().squaredNorm();
    return extended;
}

/// m' where it is given, else m.
const Eigen::VectorXd& divisor(const AveragedSide& X, const Eigen::VectorXd& relaxed) {
    return relaxed.size() > 0 ? relaxed : X.side.mass;
}

SparseMatrix mutual_averaging(const SparseMatrix& P, const Eigen::VectorXd& divisor,
                              const Eigen::VectorXd& mass) {
    return divisor.cwiseInverse().asDiagonal() * SparseMatrix(P.transpose()) * mass.asDiagonal();
}

/// What one side's centres contribute to a cost entry: sum_k a_ik |z - eta_k|^2 = alpha_i |z|^2 - 2 z . g_i +
/// c_i.
struct CollapsedSum {
    RowMatrix g;
    Eigen::VectorXd alpha, c;

    /// Without relaxed masses A is the mutual averaging, else a_ik times m_i / m'_i.
    static CollapsedSum of(const AveragedSide& X, const RowMatrix& centres, const Eigen::VectorXd& relaxed) {
        if (relaxed.size() == 0) return {X.averaging.mutual, centres};
        return {mutual_averaging(X.averaging.P, relaxed, X.side.mass), centres};
    }

    /// Mean contribution per sample for its mean image, which has the mean of squared norms in its last
    /// column.
    Eigen::VectorXd mean(const RowMatrix& image) const {
        const Eigen::Index D = image.cols() - 1;
        const Eigen::VectorXd cost =
            alpha.cwiseProduct(image.col(D)) - 2 * g.cwiseProduct(image.leftCols(D)).rowwise().sum() + c;
        return cost.cwiseMax(0);
    }

  private:
    CollapsedSum(const SparseMatrix& A, const RowMatrix& centres)
        : g(A * centres),
          alpha(A * Eigen::VectorXd::Ones(A.cols())),
          c(A * Eigen::VectorXd(centres.rowwise().squaredNorm())) {}
};

/// The centres of one side's samples towards their partners, which are points of the other side.
void pull(const std::vector<int>& partner, const RowMatrix& points, double W, RowMatrix& centres) {
    for (size_t k = 0; k < partner.size(); ++k)
        if (partner[k] >= 0) centres.row(k) = W * points.row(partner[k]) + (1 - W) * centres.row(k);
}

/// Mean images of a side's samples and what their neighbourhoods make of them.
struct SideImages {
    RowMatrix mean;           ///< samples x D: mean image of each sample
    RowMatrix sums;           ///< per neighbourhood: sum_i p_ki rho_i / m'_i (mean image)
    Eigen::VectorXd squares;  ///< the same sum of squared norms
    Eigen::VectorXd weights;  ///< the same sum of 1

    /// `image` has squared norms in its last column; rho are the transported masses.
    SideImages(const AveragedSide& X, const RowMatrix& image, const Eigen::VectorXd& rho,
               const Eigen::VectorXd& relaxed) {
        const Eigen::Index D = image.cols() - 1;
        const Eigen::VectorXd share = rho.cwiseQuotient(divisor(X, relaxed));
        const RowMatrix all = X.averaging.P * RowMatrix(share.asDiagonal() * image);
        mean = image.leftCols(D);
        sums = all.leftCols(D);
        squares = all.col(D);
        weights = X.averaging.P * share;
    }

    RowMatrix centres() const { return weights.cwiseInverse().asDiagonal() * sums; }

    /// sum_k m_k var[image of the k-th neighbourhood, eta_k].
    double energy(const Eigen::VectorXd& mass, const RowMatrix& eta) const {
        const Eigen::VectorXd spread = squares - 2 * sums.cwiseProduct(eta).rowwise().sum() +
                                       weights.cwiseProduct(Eigen::VectorXd(eta.rowwise().squaredNorm()));
        return mass.dot(spread);
    }

    /// What soft landmarks add, once they have moved the centres by W of the way to their partners.
    double landmark_energy(const Eigen::VectorXd& mass, const std::vector<int>& partner,
                           const RowMatrix& points, double W) const {
        double distances = 0;
        for (size_t k = 0; k < partner.size(); ++k)
            if (partner[k] >= 0)
                distances +=
                    mass[k] * weights[k] * (sums.row(k) / weights[k] - points.row(partner[k])).squaredNorm();
        return W * (1 - W) * distances;
    }
};

SideImages images_of_rows(const AveragedSide& X, const Side& Y, const Coupling& plan,
                          const Eigen::VectorXd& relaxed) {
    return {X, row_barycentres(plan, with_squared_norms(Y.points)), row_sums(plan), relaxed};
}
SideImages images_of_columns(const Side& X, const AveragedSide& Y, const Coupling& plan,
                             const Eigen::VectorXd& relaxed) {
    return {Y, column_barycentres(plan, with_squared_norms(X.points)), column_sums(plan), relaxed};
}

/// The m' that minimise sum_i A_i / m'_i within the bounds: clamp(s sqrt(A_i)), of sum 1.
Eigen::VectorXd least_inverses(const AveragedSide& X, const RowMatrix& image, const Eigen::VectorXd& rho,
                               const RowMatrix& centres, const MassBounds& bounds) {
    const Eigen::VectorXd mean = CollapsedSum::of(X, centres, {}).mean(image);
    const Eigen::ArrayXd A = X.side.mass.array() * rho.array() * mean.array();
    return bounded_masses(A.max(1e-300).log() / 2, bounds);
}

}  // namespace

Averaging::Averaging(const SparseMatrix& weights, const Eigen::VectorXd& mass)
    : P(weights * mass.asDiagonal()) {
    for (int k = 0; k < P.outerSize(); ++k) {
        double total = 0;
        for (SparseMatrix::InnerIterator it(P, k); it; ++it) total += it.value();
        for (SparseMatrix::InnerIterator it(P, k); it; ++it) it.valueRef() /= total;
    }
    mutual = mutual_averaging(P, mass, mass);
}

void pull_landmarks(const Side& X, const Side& Y, const Partners& partners, Centres& centres) {
    pull(partners.row, Y.points, partners.weight, centres.row);
    pull(partners.column, X.points, partners.weight, centres.column);
}

CostFactors::CostFactors(const AveragedSide& averaged_X, const AveragedSide& averaged_Y,
                         const Centres& centres, const RelaxedMasses& relaxed) {
    const CollapsedSum x = CollapsedSum::of(averaged_X, centres.row, relaxed.row),
                       y = CollapsedSum::of(averaged_Y, centres.column, relaxed.column);
    const Side &X = averaged_X.side, &Y = averaged_Y.side;
    const Eigen::Index DX = X.points.cols(), DY = Y.points.cols();
    const Eigen::Index further = X.descriptor.size() > 0 ? X.descriptor.cols() + 2 : 0;
    const Eigen::Index columns = DX + DY + 4 + further;
    u_.resize(X.points.rows(), columns);
    v_.resize(Y.points.rows(), columns);
    const Eigen::VectorXd one_x = Eigen::VectorXd::Ones(u_.rows()), one_y = Eigen::VectorXd::Ones(v_.rows());
    u_.leftCols(DX + DY + 4) << -2 * x.g, X.points, x.alpha, X.points.rowwise().squaredNorm(), x.c, one_x;
    v_.leftCols(DX + DY + 4) << Y.points, -2 * y.g, Y.points.rowwise().squaredNorm(), y.alpha, one_y, y.c;
    if (further == 0) return;
    u_.rightCols(further) << -2 * X.descriptor, X.descriptor.rowwise().squaredNorm(), one_x;
    v_.rightCols(further) << Y.descriptor, one_y, Y.descriptor.rowwise().squaredNorm();
}

Eigen::VectorXd CostFactors::on(const Support& support) const {
    Eigen::VectorXd cost(support.entries());
    parallel_for_each_index(0 + support.rows(), 32, [&](int i) {
        for (int e = support.row_begin[i]; e < support.row_begin[i + 1]; ++e) {
            const double c = entry(i, support.column[e]);
            cost[e] = c <= 0 ? 0 : c;  // what is no number stays so, that it be noticed
        }
    });
    return cost;
}

CentreStep update_centres(const AveragedSide& averaged_X, const AveragedSide& averaged_Y,
                          const Coupling& plan, const RelaxedMasses& relaxed, const Partners& partners) {
    const Side &X = averaged_X.side, &Y = averaged_Y.side;
    SideImages rows = images_of_rows(averaged_X, Y, plan, relaxed.row),
               columns = images_of_columns(X, averaged_Y, plan, relaxed.column);
    CentreStep step;
    step.centres = {rows.centres(), columns.centres()};
    pull_landmarks(X, Y, partners, step.centres);
    step.energy = rows.energy(X.mass, step.centres.row) + columns.energy(Y.mass, step.centres.column) +
                  rows.landmark_energy(X.mass, partners.row, Y.points, partners.weight) +
                  columns.landmark_energy(Y.mass, partners.column, X.points, partners.weight);
    step.row_image = std::move(rows.mean);
    step.column_image = std::move(columns.mean);
    return step;
}

RelaxedMasses update_relaxed_masses(const AveragedSide& X, const AveragedSide& Y, const Coupling& plan,
                                    const Centres& centres, const PlanBounds& bounds) {
    return {least_inverses(X, row_barycentres(plan, with_squared_norms(Y.side.points)), row_sums(plan),
                           centres.row, bounds.row),
            least_inverses(Y, column_barycentres(plan, with_squared_norms(X.side.points)), column_sums(plan),
                           centres.column, bounds.column)};
}

}  // namespace varimap
