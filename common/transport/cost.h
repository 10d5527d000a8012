#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/transport/support.h"

namespace varimap {

/// One surface at one level, as the transport problem sees it.
struct Side {
    RowMatrix points;          ///< samples x D: the embedding in which the OTHER side's images are averaged and spread
    Eigen::VectorXd mass;      ///< per sample, sums to 1
    SparseMatrix weights;      ///< row k: W_k(x_i) over its neighbourhood
    SparseMatrix reach;        ///< pattern of the neighbourhoods by which the plan's support grows; holds the diagonal
    SparseMatrix averaging;    ///< P: p_ki = m_i W_k(x_i) / sum_i' m_i' W_k(x_i'); rows sum to 1
    std::vector<int> partner;  ///< per sample: the other side's sample it is pinned to (a landmark), or -1
    RowMatrix aligned;          ///< samples x 3 positions times sqrt(weight) of the Wasserstein-2 term; may be empty
};

/// P of a side: weights times masses, rows normalised (the measure W_x mu / mass(W_x mu) of Eq. 1).
SparseMatrix averaging_operator(const SparseMatrix& weights, const Eigen::VectorXd& mass);

/// The auxiliary variables eta (Sec. 2.3): images of each side's weighted neighbourhoods, in the other's embedding.
struct Centres {
    RowMatrix row;     ///< samples of X x D_Y
    RowMatrix column;  ///< samples of Y x D_X
};

/// Cost of every instantiated entry with the centres fixed (the coefficient of pi_ij in Eq. 3):
///   c_ij = sum_k a_ik |y_j - eta_xk|^2 + sum_l b_jl |x_i - eta_yl|^2,  a_ik = m_k W_k(x_i) / Z_k,
/// collapsed into one dot product of D_X + D_Y + 4 numbers per entry: c_ij = u_i . v_j.
class CostFactors {
  public:
    CostFactors(const Side& X, const Side& Y, const Centres& centres);
    double entry(int i, int j) const { return u_.row(i).dot(v_.row(j)); }
    Eigen::VectorXd on(const Support& support) const;

  private:
    RowMatrix u_, v_;
};

/// Half-step over the centres: eta_xk = mean image of the samples x_i, weighted by p_ki rho_i / m_i, landmarks pinned;
/// and the energy of Eq. (3) for the plan and these centres, without the Wasserstein-2 term. rho_i is the
/// transported mass of row i, which is m_i unless the marginals are relaxed.
struct CentreStep {
    Centres centres;
    RowMatrix row_image, column_image;  ///< mean images of the samples themselves (pi_X(delta_x), pi_Y(delta_y))
    double energy;
};
CentreStep update_centres(const Side& X, const Side& Y, const Coupling& plan);

/// Energy of Eq. (3) for any centres, from the mean images of the samples and of their squared norms.
double energy(const Side& X, const Side& Y, const Coupling& plan, const Centres& centres);

/// Replaces the centres of landmarks by their partners' points.
void pin_landmarks(const Side& X, const Side& Y, Centres& centres);

}  // namespace varimap
