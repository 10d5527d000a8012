#pragma once

#include "stages/gromov/params.h"
#include "varimap/results/plan.h"
#include "varimap/surface/domain.h"

namespace varimap {

/// The plain entropic Gromov-Wasserstein plan between all points of two domains (Solomon et al. 2016,
/// Entropic Metric Alignment; Peyre, Cuturi and Solomon 2016), from the product of the masses:
///   min sum_ijkl (d_ik - d'_jl)^2 pi_ij pi_kl + gamma KL(pi | m n'),   masses exact,
/// by repeated transport with the costs of the plan before, d and d' along edges. Its trace holds the energy
/// without entropy. Throws UsageError for more points than memory bears.
Plan gromov_wasserstein(const Domain& A, const Domain& B, const GromovParams& params);

}  // namespace varimap
