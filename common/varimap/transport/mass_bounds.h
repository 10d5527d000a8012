#pragma once

#include <Eigen/Core>

namespace varimap {

/// Bounds on the mass that each line (row or column) of a plan carries (Sec. 3.4):
///   lower_i <= sum_j pi_ij <= upper_i,   sum of lower <= 1 <= sum of upper.
struct MassBounds {
    Eigen::VectorXd lower, upper;

    /// [mass / factor, mass * factor]; a factor of 1 demands the masses exactly.
    static MassBounds around(const Eigen::VectorXd& mass, double factor);
    /// The masses nearest to the given ones, in the sense of KL, that keep the bounds and sum to 1.
    Eigen::VectorXd projected(const Eigen::VectorXd& mass) const;
    /// The intersection with other bounds; it must hold a vector of sum 1 for the sums above to remain true.
    MassBounds within(const MassBounds& other) const;
    bool exact() const { return lower == upper; }
    /// Largest share by which one of the masses leaves its bounds; 0 if all keep them.
    double excess(const Eigen::VectorXd& mass) const;
};

/// Bounds on both marginals of a plan.
struct PlanBounds {
    MassBounds row, column;
};

/// clamp(phi a_i, lower_i, upper_i) with the phi that makes their sum 1 (App. A; Alg. 4, Global_Mass and
/// Update_Vector_Global_Mass). Given are the logarithms of the a_i, which may spread over any range.
///
/// The sum is piecewise linear and does not decrease in phi. Newton's method, kept within an interval that
/// holds phi, ends in a few steps of O(n). Where the a_i spread too far for that, the breakpoints lower_i /
/// a_i and upper_i / a_i around sum 1 are found by bisection of their sorted list, and between those phi
/// solves a linear equation: O(n log n). Every evaluation sums afresh: a running sum would lose the small a_i
/// behind the large ones.
Eigen::VectorXd bounded_masses(const Eigen::ArrayXd& log_a, const MassBounds& bounds);

}  // namespace varimap
