#pragma once

#include <vector>

#include "common/mapping/level_transfer.h"
#include "common/mapping/plan.h"

namespace varimap {

/// Alternating minimisation of one level (Alg. 1), logged, with a row appended to the trace per alternation.
Solution solve_level(const LevelPair& pair, const Start& start, int level_index, const AlternationOptions& options,
                     std::vector<TraceRow>& trace);

/// The plan's entries that are at least a thousandth of their row's or column's mass, as a matrix.
SparseMatrix to_matrix(const Coupling& plan, const Eigen::VectorXd& row_mass, const Eigen::VectorXd& column_mass);
/// The plan back from a matrix, without background.
Coupling to_coupling(const SparseMatrix& plan);

}  // namespace varimap
