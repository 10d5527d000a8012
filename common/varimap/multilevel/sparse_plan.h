#pragma once

#include "varimap/multilevel/level_transfer.h"
#include "varimap/results/sample_plan.h"

namespace varimap {

/// The plan's entries that are at least a thousandth of their row's or column's mass, as a matrix.
SparseMatrix to_matrix(const Coupling& plan, const Eigen::VectorXd& row_mass,
                       const Eigen::VectorXd& column_mass);
/// The plan back from a matrix, without background.
Coupling to_coupling(const SparseMatrix& plan);

/// What artifacts keep of a plan between the samples of a level, solved within this area bound.
SamplePlan to_sample_plan(const LevelPair& pair, const Coupling& plan, double area_bound);

}  // namespace varimap
