#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "common/transport/cost.h"
#include "common/transport/sinkhorn.h"

/// Random transport problems, and plans written out in full.
namespace varimap::random_plan {

class Generator {
  public:
    explicit Generator(unsigned seed) : random_(seed) {}
    double uniform() { return double(random_()) / 4294967296.0; }

    RowMatrix points(int n, int dimension) {
        return RowMatrix::NullaryExpr(n, dimension, [&] { return 2 * uniform() - 1; });
    }
    /// Positive, of sum 1, the largest about ten times the smallest.
    Eigen::VectorXd mass(int n) {
        const Eigen::VectorXd m = Eigen::VectorXd::NullaryExpr(n, [&] { return .1 + uniform(); });
        return m / m.sum();
    }
    /// Each entry with a probability, every row and column at least once where a diagonal exists.
    Support support(int rows, int columns, double share) {
        std::vector<std::vector<int>> lists(rows);
        for (int i = 0; i < rows; ++i)
            for (int j = 0; j < columns; ++j)
                if (j == i % columns || i == j % rows || uniform() < share) lists[i].push_back(j);
        return Support(lists, columns);
    }
    Eigen::VectorXd values(int n) {
        return Eigen::VectorXd::NullaryExpr(n, [&] { return uniform(); });
    }
    /// Weights of random neighbourhoods, not symmetric, with W_k(x_k) = 1.
    SparseMatrix weights(int n, double share) {
        std::vector<Eigen::Triplet<double>> entries;
        for (int k = 0; k < n; ++k)
            for (int i = 0; i < n; ++i)
                if (i == k)
                    entries.emplace_back(k, i, 1);
                else if (uniform() < share)
                    entries.emplace_back(k, i, .5 + .5 * uniform());
        SparseMatrix W(n, n);
        W.setFromTriplets(entries.begin(), entries.end());
        return W;
    }
    Side side(int n, int dimension) {
        Side side;
        side.points = points(n, dimension);
        side.mass = mass(n);
        side.weights = weights(n, .2);
        side.reach = side.weights;
        side.averaging = averaging_operator(side.weights, side.mass);
        side.partner.assign(n, -1);
        return side;
    }

  private:
    std::mt19937 random_;
};

/// A function on a support as a full matrix, `elsewhere` off the support.
inline RowMatrix dense(const Support& s, const Eigen::VectorXd& value, double elsewhere) {
    RowMatrix full = RowMatrix::Constant(s.rows(), s.columns(), elsewhere);
    for (int i = 0; i < s.rows(); ++i)
        for (int e = s.row_begin[i]; e < s.row_begin[i + 1]; ++e) full(i, s.column[e]) = value[e];
    return full;
}

inline RowMatrix dense(const Coupling& plan) {
    return dense(plan.support, plan.value, 0) + plan.row_background * plan.column_background.transpose();
}

}  // namespace varimap::random_plan
