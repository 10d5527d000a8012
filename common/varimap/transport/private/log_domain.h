#pragma once

#include "varimap/transport/sinkhorn.h"

namespace varimap {

// The half-steps of Sinkhorn's iteration as log-sum-exp, on potentials ("Working in log space").

/// Lines that are worth a task.
inline constexpr int rows_per_task = 512;

/// The kernel of a problem, in the log domain.
struct LogKernel {
    Eigen::VectorXd entry;  ///< log excess kernel per entry, row order
    double background;      ///< log of the background kernel

    explicit LogKernel(const TransportProblem& p);
};

/// The masses that one side's lines take on in the KL projection onto their bounds. Without bounds and total,
/// a line that carries s before the projection and should carry m would take on m^lambda s^(1 - lambda),
/// lambda = rho / (rho + gamma); the total's multiplier scales these by a common phi, and the bounds clamp
/// them.
class Projection {
  public:
    Projection(const Eigen::VectorXd& mass, const MassBounds& bounds, const TransportProblem& p)
        : bounds_(bounds), exact_(bounds.exact()), lambda_(p.mass_penalty / (p.mass_penalty + p.gamma)) {
        if (!exact_) log_mass_ = mass.array().log();
    }
    bool exact() const { return exact_; }
    /// Given log(s / m) for every line, with the side's own potentials taken out.
    Eigen::VectorXd masses(const Eigen::ArrayXd& log_ratio) const {
        return exact_ ? bounds_.lower : bounded_masses(log_mass_ + (1 - lambda_) * log_ratio, bounds_);
    }

  private:
    const MassBounds& bounds_;
    bool exact_;
    double lambda_;
    Eigen::ArrayXd log_mass_;
};

/// A problem with the projections of its two sides.
struct Projections {
    Projection rows, columns;
    explicit Projections(const TransportProblem& p)
        : rows(p.row_mass, p.row_bounds, p), columns(p.column_mass, p.column_bounds, p) {}
};

/// The potentials of one side, given those of the other (Alg. 2 and 3).
void update_rows(const TransportProblem& p, const Projections& projections, const LogKernel& kernel,
                 Potentials& q);
void update_columns(const TransportProblem& p, const Projections& projections, const LogKernel& kernel,
                    Potentials& q);

/// The plan that belongs to a pair of potentials. Entries below `negligible` times the mass of their row or
/// column may be 0.
void form_plan(const TransportProblem& p, const LogKernel& kernel, const Potentials& q, double negligible,
               Coupling& plan);

}  // namespace varimap
