#pragma once

#include <vector>

#include "varimap/multilevel/ironing.h"
#include "varimap/results/trace.h"

namespace varimap {

/// Alternating minimisation of one level (Alg. 1), then ironing (Sec. 4.4); logged, with a row appended to
/// the trace per alternation. The `last` level of a stage ends with a plan that keeps the area bound tightly.
Solution solve_level(const PairContext& context, LevelPair& pair, const Start& start, int level_index,
                     const AlternationOptions& options, const IroningOptions& ironing, bool last,
                     Trace& trace);

/// The plan's entries that are at least a thousandth of their row's or column's mass, as a matrix.
SparseMatrix to_matrix(const Coupling& plan, const Eigen::VectorXd& row_mass,
                       const Eigen::VectorXd& column_mass);
/// The plan back from a matrix, without background.
Coupling to_coupling(const SparseMatrix& plan);

}  // namespace varimap
