#pragma once

#include <Eigen/Core>
#include <limits>

#include "common/transport/support.h"

namespace varimap {

/// Entropic optimal transport on a sparse support with a constant background cost (Sec. 3.3, 4.3):
///   min sum pi_ij c_ij + gamma sum pi_ij (log(pi_ij / (m_i n_j)) - 1) + rho KL(pi 1 | m) + rho KL(pi' 1 | n)
/// where c_ij is `cost` on the support and `background_cost` everywhere else. An infinite rho demands the marginals
/// m and n exactly (Alg. 2); a finite one lets mass, and so area, change where that saves more cost than it
/// costs (unbalanced transport; Chizat et al. 2016, Scaling Algorithms for Unbalanced Transport Problems).
struct TransportProblem {
    const Support& support;
    const Eigen::VectorXd& cost;  ///< per entry of the support, in row order
    const Eigen::VectorXd& row_mass;
    const Eigen::VectorXd& column_mass;
    double gamma;
    double background_cost;  ///< larger than every cost
    double mass_penalty = std::numeric_limits<double>::infinity();  ///< rho, units of the cost

    /// Exponent of the scaling updates, rho / (rho + gamma); 1 for exact marginals.
    double relaxation() const { return 1 / (1 + gamma / mass_penalty); }
};

/// Dual potentials in units of the cost: pi_ij = m_i n_j exp((f_i + g_j - c_ij) / gamma).
struct Potentials {
    Eigen::VectorXd row, column;
    static Potentials zero(int rows, int columns) {
        return {Eigen::VectorXd::Zero(rows), Eigen::VectorXd::Zero(columns)};
    }
};

struct SinkhornOptions {
    double tolerance = 1e-2;     ///< stop when one more row update would move less than this mass
    int maximum_iterations = 1000;
};

struct SinkhornReport {
    int iterations = 0;
    /// Mass that one more row update would move (L1); for exact marginals the distance of the row sums from
    /// the row masses, while the column sums are exact.
    double marginal_error = 0;
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
