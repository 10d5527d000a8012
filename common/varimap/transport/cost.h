#pragma once

#include <Eigen/Core>
#include <vector>

#include "varimap/transport/mass_bounds.h"
#include "varimap/transport/support.h"

namespace varimap {

/// How the samples of a side count in the means of its neighbourhoods (the measure W_x mu / mass(W_x mu) of
/// Eq. 1).
struct Averaging {
    SparseMatrix P;  ///< p_ki = m_i W_k(x_i) / sum_i' m_i' W_k(x_i'): weights times masses, rows sum to 1
    SparseMatrix mutual;  ///< diag(1/m) P' diag(m): a_ik = m_k W_k(x_i) / Z_k of the costs (RelaxedMasses)

    Averaging() = default;
    Averaging(const SparseMatrix& weights, const Eigen::VectorXd& mass);
};

/// One surface at one level, as the transport problem sees it. Solving changes nothing of it.
struct Side {
    RowMatrix
        points;  ///< samples x D: the embedding in which the OTHER side's images are averaged and spread
    Eigen::VectorXd mass;     ///< per sample, sums to 1
    SparseMatrix weights;     ///< row k: W_k(x_i) over its neighbourhood
    SparseMatrix neighbours;  ///< pattern along which the plan's support grows; holds the diagonal
    Averaging averaging;
    RowMatrix descriptor;  ///< samples x F: |f_i - f_j|^2 adds to the cost of an entry (descriptor_terms.h);
                           ///< may be empty
};

/// A side with the averaging that counts: its own, or that of damped samples (Sec. 4.4). Refers to both.
struct AveragedSide {
    const Side& side;
    const Averaging& averaging;
    AveragedSide(const Side& own) : side(own), averaging(own.averaging) {}
    AveragedSide(const Side& own, const Averaging& other) : side(own), averaging(other) {}
};

/// Landmarks at a level: samples that belong together, and how firmly.
struct Partners {
    std::vector<int> row, column;  ///< per sample of X (of Y): its sample of Y (of X), or -1; empty: none
    double weight = 1;             ///< W of pull_landmarks, in (0, 1]
};

/// The auxiliary variables eta (Sec. 2.3): images of each side's weighted neighbourhoods, in the other's
/// embedding.
struct Centres {
    RowMatrix row;     ///< samples of X x D_Y
    RowMatrix column;  ///< samples of Y x D_X
};

/// The variables m' and n' of Sec. 3.4, by which the images of the samples are divided; empty: the masses m
/// and n.
///
/// With cX_ij = sum_k a_ik |y_j - eta_xk|^2, a_ik = m_k W_k(x_i) / Z_k, and its twin cY, Eq. (3) for the
/// transfer operators divided by m' and n' is
///   C'(pi, m', n', eta) = sum_i (m_i / m'_i) sum_j pi_ij cX_ij + sum_j (n_j / n'_j) sum_i pi_ij cY_ij,
/// subject to m'_i in [m_i / D, D m_i] and rho_i = sum_j pi_ij in [m'_i / C, C m'_i], the same for n', and
/// sum pi = sum m' = sum n' = 1. The text only implies the sum of m'; without it every m'_i would go to its
/// upper bound. Each half-step is a convex problem:
///   pi    transport with the costs above, row sums within [m' / C, C m'], column sums within [n' / C, C n'];
///   m'    m'_i = clamp(s sqrt(A_i)) to [m_i / D, D m_i] and [rho_i / C, C rho_i], with the s that
///         makes their sum 1,
///         where A_i = m_i sum_j pi_ij cX_ij;
///   eta   eta_xk = sum_i w_ki (mean image of x_i) / sum_i w_ki, with the weights
///         w_ki = m_i W_k(x_i) rho_i / m'_i:
///         the weighted average that the text speaks of.
///
/// Where D exceeds 1, C' lets both one-way maps shrink: a light sample counts in full in its own row, but
/// adds only D^-2 to the variance of its heavy partner's, so light samples gather in heavy ones almost for
/// free. The energy that varimap minimises by default keeps m' = m and n' = n: the costs are cX + cY, and the
/// centres weigh samples by the mass that they transport, W_k rho. Then there are two half-steps, and the
/// bounds hold for rho itself.
struct RelaxedMasses {
    Eigen::VectorXd row, column;
};

/// Cost of every instantiated entry with the rest fixed (the coefficient of pi_ij in C'):
///   c_ij = m_i / m'_i cX_ij + n_j / n'_j cY_ij
/// collapsed into one dot product of D_X + D_Y + 4 numbers per entry: c_ij = u_i . v_j.
class CostFactors {
  public:
    CostFactors(const AveragedSide& X, const AveragedSide& Y, const Centres& centres,
                const RelaxedMasses& relaxed = {});
    double entry(int i, int j) const { return u_.row(i).dot(v_.row(j)); }
    Eigen::VectorXd on(const Support& support) const;

  private:
    RowMatrix u_, v_;
};

/// Half-step over the centres: eta_xk = mean image of the samples x_i, weighted by p_ki rho_i / m'_i,
/// landmarks pulled; and the energy C' for the plan and these centres, with what soft landmarks add, without
/// the costs of descriptors.
struct CentreStep {
    Centres centres;
    RowMatrix row_image,
        column_image;  ///< mean images of the samples themselves (pi_X(delta_x), pi_Y(delta_y))
    double energy;
};
CentreStep update_centres(const AveragedSide& X, const AveragedSide& Y, const Coupling& plan,
                          const RelaxedMasses& relaxed = {}, const Partners& partners = {});

/// Half-step over m' and n': with the rest fixed C' = sum_i A_i / m'_i + sum_j B_j / n'_j, A_i = m_i sum_j
/// pi_ij cX_ij.
RelaxedMasses update_relaxed_masses(const AveragedSide& X, const AveragedSide& Y, const Coupling& plan,
                                    const Centres& centres, const PlanBounds& bounds);

/// Landmarks: the centre of a sample k with a partner becomes W y + (1 - W) eta_k, where y is the partner's
/// point. W = 1 pins it, as the paper does. A smaller W makes it soft: then the blend is the best centre for
/// an energy in which each such sample adds to C'
///   W / (1 - W) s_k m_k |eta_k - y|^2,   s_k = sum_i p_ki rho_i / m'_i (1 where masses are exact),
/// so that the map may disagree: it pays W times what it would pay for the same images were the landmark
/// pinned.
void pull_landmarks(const Side& X, const Side& Y, const Partners& partners, Centres& centres);

}  // namespace varimap
