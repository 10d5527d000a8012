#pragma once

#include <Eigen/Core>
#include <vector>

#include "varimap/core/linear_algebra.h"

namespace varimap {

/// A transport plan between samples of two surfaces.
struct SamplePlan {
    std::vector<int> samples_A, samples_B;         ///< vertices of the two surfaces' meshes
    Eigen::VectorXd mass_A, mass_B;                ///< masses of the samples, each sums to 1
    Eigen::VectorXd transported_A, transported_B;  ///< row and column sums of the plan, each sums to 1
    double area_bound = 1;  ///< B: each of them within a factor of sqrt(B) of its mass (Sec. 3.4)
    SparseMatrix entries;   ///< |A| x |B|; those below a thousandth of their row and column are dropped
};

}  // namespace varimap
