#pragma once

#include <Eigen/Core>
#include <limits>

#include "varimap/transport/mass_bounds.h"
#include "varimap/transport/support.h"

namespace varimap {

/// Entropic optimal transport on a sparse support with a constant background cost (Sec. 3.3, 4.3):
///   min sum pi_ij c_ij + gamma sum pi_ij (log(pi_ij / (m_i n_j)) - 1) + rho KL(pi 1 | m) + rho KL(pi' 1 | n)
///   subject to sum pi_ij = 1, pi 1 within the row bounds, pi' 1 within the column bounds,
/// where c_ij is `cost` on the support and `background_cost` everywhere else. Bounds that leave no room
/// demand the masses exactly (Alg. 2); others let mass, and so area, change within them (Sec. 3.4). There rho
/// makes a change of mass cost something of its own (unbalanced transport; Chizat et al. 2016, Scaling
/// Algorithms for Unbalanced Transport Problems); the paper has rho = 0.
struct TransportProblem {
    const Support& support;
    const Eigen::VectorXd& cost;  ///< per entry of the support, in row order
    const Eigen::VectorXd& row_mass;
    const Eigen::VectorXd& column_mass;
    double gamma;
    double background_cost;  ///< larger than every cost
    MassBounds row_bounds = MassBounds::around(row_mass, 1),
               column_bounds = MassBounds::around(column_mass, 1);
    double mass_penalty = 0;  ///< rho, units of the cost
};

/// Dual potentials in units of the cost: pi_ij = m_i n_j exp((f_i + g_j - c_ij) / gamma).
struct Potentials {
    Eigen::VectorXd row, column;
    static Potentials zero(int rows, int columns) {
        return {Eigen::VectorXd::Zero(rows), Eigen::VectorXd::Zero(columns)};
    }
};

/// When the iteration stops.
struct SinkhornOptions {
    double tolerance = 1e-2;  ///< stop when one more row update would move less than this mass
    int maximum_iterations = 1000;
};

/// Where it stopped.
struct SinkhornReport {
    int iterations = 0;
    /// Mass that one more row update would move (L1); for exact masses the distance of the row sums from the
    /// row masses, while the column sums are exact.
    double marginal_error = 0;
};

/// Alg. 2 and 3: alternating KL projections onto the plans whose row sums and whose column sums keep their
/// bounds (App. A), as stabilised scaling: matrix-vector products in the linear domain on a kernel that has
/// absorbed the potentials, which are renewed in the log domain whenever the scalings leave a safe range.
/// Starts from `potentials` and leaves the solution there. `plan.support` must be the problem's support.
SinkhornReport sinkhorn(const TransportProblem& problem, const SinkhornOptions& options,
                        Potentials& potentials, Coupling& plan);

/// The same iteration with every product as log-sum-exp ("Working in log space"): the slower reference.
SinkhornReport sinkhorn_log_domain(const TransportProblem& problem, const SinkhornOptions& options,
                                   Potentials& potentials, Coupling& plan);

/// Moves a plan to exactly the given row and column sums, both of sum 1, by about as much mass as they were
/// missed by (Altschuler, Weed, Rigollet 2017, Near-linear time approximation algorithms for optimal
/// transport, Alg. 2): rows and then columns that hold too much are scaled down, and what is missing becomes
/// the background.
void round_to_masses(const Eigen::VectorXd& row_mass, const Eigen::VectorXd& column_mass, Coupling& plan);

}  // namespace varimap
