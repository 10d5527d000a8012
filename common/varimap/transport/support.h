#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "varimap/core/linear_algebra.h"

namespace varimap {

/// The instantiated entries of a plan (Sec. 4.3): a sparse pattern by rows, and the same entries by columns
/// so that both products of a Sinkhorn iteration read memory forwards and are deterministic for any threads.
class Support {
  public:
    Support() = default;
    /// `columns[i]` are the sorted, distinct columns of row i.
    Support(std::vector<std::vector<int>> columns, int column_count);
    static Support dense(int rows, int columns);

    int rows() const { return int(row_begin.size()) - 1; }
    int columns() const { return int(column_begin.size()) - 1; }
    int entries() const { return int(column.size()); }

    std::vector<int> row_begin;     ///< rows + 1
    std::vector<int> column;        ///< per entry, ordered by row
    std::vector<int> column_begin;  ///< columns + 1
    std::vector<int> row;           ///< per entry, ordered by column
    std::vector<int> by_row;        ///< per entry ordered by column: its place in row order
};

/// A transport plan: pi_ij = value_ij + row_background_i * column_background_j, where value is zero off the
/// support. The rank-one term is what the non-instantiated entries carry (Sec. 4.3); it is negligible once
/// the support is wide enough.
struct Coupling {
    Support support;
    Eigen::VectorXd value;              ///< per entry of the support, in row order
    Eigen::VectorXd row_background;     ///< per row
    Eigen::VectorXd column_background;  ///< per column
};

/// pi 1 (per row) and pi' 1 (per column), with the background.
Eigen::VectorXd row_sums(const Coupling& plan);
Eigen::VectorXd column_sums(const Coupling& plan);

/// Per row (per column): the column (the row) of its largest entry, the first of equals; 0 where the support
/// has none.
std::vector<int> largest_of_rows(const Coupling& plan);
std::vector<int> largest_of_columns(const Coupling& plan);

/// Mean image of each row: sum_j pi_ij points_j / sum_j pi_ij (the transfer operator pi_X, Sec. 2.1).
RowMatrix row_barycentres(const Coupling& plan, const RowMatrix& points);
/// Mean image of each column under pi_Y.
RowMatrix column_barycentres(const Coupling& plan, const RowMatrix& points);

/// Entries that matter: at least `threshold` of their row's or of their column's mass, and the best entry of
/// every row and of every column. Row i of the result lists its columns, sorted.
std::vector<std::vector<int>> significant_entries(const Coupling& plan, const Eigen::VectorXd& row_mass,
                                                  const Eigen::VectorXd& column_mass, double threshold);

/// Enlarged support (Sec. 4.3): all (x', y') with x in N_x', y' in N_y for some kept (x, y). Neighbourhoods
/// are the patterns of the matrices' rows, which contain the diagonal; they need not be mutual.
Support enlarged(const std::vector<std::vector<int>>& kept, const SparseMatrix& row_neighbours,
                 const SparseMatrix& column_neighbours);

/// Kept entries of a coarse plan handed down: (i, j) wherever (parent(i), parent(j)) is kept.
std::vector<std::vector<int>> inherited(const std::vector<std::vector<int>>& kept,
                                        const std::vector<int>& row_parent,
                                        const std::vector<int>& column_parent);

}  // namespace varimap
