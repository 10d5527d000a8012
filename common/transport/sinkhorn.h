#pragma once

#include <Eigen/Core>

#include "common/transport/support.h"

namespace varimap {

/// Entropic optimal transport on a sparse support with a constant background cost (Sec. 3.3, 4.3):
///   min sum pi_ij c_ij + gamma sum pi_ij (log(pi_ij / (m_i n_j)) - 1)   with marginals m and n,
/// where c_ij is `cost` on the support and `background_cost` everywhere else.
struct TransportProblem {
    const Support& support;
    const Eigen::VectorXd& cost;  ///< per entry of the support, in row order
    const Eigen::VectorXd& row_mass;
    const Eigen::VectorXd& column_mass;
    double gamma;
    double background_cost;  ///< larger than every cost
};

/// Dual potentials in units of the cost: pi_ij = m_i n_j exp((f_i + g_j - c_ij) / gamma).
struct Potentials {
    Eigen::VectorXd row, column;
    static Potentials zero(int rows, int columns) {
        return {Eigen::VectorXd::Zero(rows), Eigen::VectorXd::Zero(columns)};
    }
};

struct SinkhornOptions {
    double tolerance = 1e-2;     ///< stop when the row sums are this close to the masses in L1
    int maximum_iterations = 1000;
};

struct SinkhornReport {
    int iterations = 0;
    double marginal_error = 0;  ///< L1 distance of row sums from row masses; column sums are exact
};

/// Alg. 2 as stabilised scaling: matrix-vector products in the linear domain on a kernel that has absorbed the
/// potentials, which are renewed in the log domain whenever the scalings leave a safe range. Starts from
/// `potentials` and leaves the solution there. `plan.support` must be the problem's support.
SinkhornReport sinkhorn(const TransportProblem& problem, const SinkhornOptions& options, Potentials& potentials,
                        Coupling& plan);

/// The same iteration with every product as log-sum-exp ("Working in log space"): the slower reference.
SinkhornReport sinkhorn_log_domain(const TransportProblem& problem, const SinkhornOptions& options,
                                   Potentials& potentials, Coupling& plan);

}  // namespace varimap
