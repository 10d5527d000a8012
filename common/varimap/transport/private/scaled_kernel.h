#pragma once

#include <vector>

#include "varimap/transport/sinkhorn.h"

namespace varimap {

/// The scaling phase: pi = D_u (K + r q') D_w for a kernel that already holds the potentials. Entries that
/// cannot matter while the scalings stay in their safe range are left out of the products: at small gamma
/// that is nine in ten.
class ScaledKernel {
  public:
    ScaledKernel(const TransportProblem& p, const Coupling& absorbed, double negligible);

    Eigen::VectorXd times(const Eigen::VectorXd& w) const;
    Eigen::VectorXd transposed_times(const Eigen::VectorXd& u) const;

  private:
    /// A sparse matrix in the order in which one of the two products reads it.
    struct CompressedLines {
        std::vector<int> begin, index;
        std::vector<double> value;

        void make_room(std::size_t entries);
        double line_times(int line, const Eigen::VectorXd& x) const;
    };
    void transpose_rows();
    static Eigen::VectorXd product(const CompressedLines& lines, const Eigen::VectorXd& x,
                                   const Eigen::VectorXd& background, double background_total);

    const Coupling& k_;
    CompressedLines rows_, columns_;
};

}  // namespace varimap
