#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace varimap {

/// A sparse symmetric system A x = b with two unknowns per node, A the sum of one 6 x 6 matrix per triangle
/// of nodes. Solved by a factorisation A = L D L' into 2 x 2 blocks, row by row (up-looking), in an order of
/// approximate minimum degree; with a quarter of the indices of a factorisation by single entries.
/// A step of relaxation on a sphere, put together, factorised and solved (tests/benchmarks), takes 0.17 s of
/// CPU time with 10'242 nodes and 1.5 s with 40'962, and Eigen's SimplicialLDLT 2.4 and 2.7 times as long.
class TriangleSystem {
  public:
    using Block = Eigen::Matrix2d;
    using TriangleMatrix = Eigen::Matrix<double, 6, 6>;

    /// triangles: nodes from 0 to node_count - 1, or -1: a corner without unknowns.
    TriangleSystem(int node_count, const std::vector<std::array<int, 3>>& triangles);

    /// A = 0.
    void clear();
    /// Adds weight times a symmetric matrix to A, corner by corner.
    void add(int triangle, const TriangleMatrix& matrix, double weight);
    /// Adds a symmetric matrix to the diagonal block of a node.
    void add(int node, const Block& block) { diagonal(position_[node]) += block; }
    /// Multiplies the diagonal of A.
    void scale_diagonal(double factor);

    /// False if A is singular; else A can be solved with.
    bool factorize();
    /// x, two rows per node.
    Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

  private:
    void build_pattern();
    void order();
    void find_slots();
    void count_factor();
    int row_pattern(int k);
    Block& diagonal(int k) { return upper_[begin_[k + 1] - 1]; }

    std::vector<std::array<int, 3>> triangles_;  ///< corners' positions in the order of elimination; or -1
    std::vector<int> position_;                  ///< of nodes
    /// A: blocks above the diagonal and, last, on it, by columns. slot_: per triangle, of the side opposite a
    /// corner.
    std::vector<int> begin_, row_;
    std::vector<std::array<int, 3>> slot_;
    std::vector<Block> upper_;
    /// L without its unit diagonal, by columns, blocks transposed; and the inverse of D.
    std::vector<int> parent_, factor_begin_, factor_end_, factor_row_;
    std::vector<Block> factor_, inverse_;
    std::vector<int> pattern_, visited_;  ///< workspace: columns with an entry in the present row of L
    std::vector<Block> present_;          ///< workspace: that row of L D
};

}  // namespace varimap
