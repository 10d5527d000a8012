#pragma once

#include "common/stage/parameters.h"
#include "common/transport/alternating_minimization.h"

namespace varimap {

/// Parameters of every stage that solves for a plan.
inline void describe(ParameterList& list, AlternationOptions& o) {
    list.add("tolerance", o.tolerance, "a level ends when the energy changes by less than this share (Alg. 1)", 0.0, 1.0);
    list.add("maximum_alternations", o.maximum_alternations, "alternations per level at most", 1, 10000);
    list.add("gamma_divisor", o.gamma_divisor, "gamma = largest instantiated cost / this (Sec. 3.3)", 1.0, 1e5);
    list.add("annealing_divisor", o.annealing_divisor, "gamma of a level's first solve = largest cost / this", 1.0, 1e5);
    list.add("marginal_tolerance", o.marginal_tolerance, "L1 error of the row sums at which Sinkhorn stops", 1e-14, 0.5);
    list.add("sinkhorn_iterations", o.sinkhorn_iterations, "Sinkhorn iterations per solve at most", 1, 1000000);
    list.add("support_threshold", o.support_threshold,
             "entries below this share of their row's and column's mass do not spread (Sec. 4.3)", 1e-9, 0.5);
    list.add("background_factor", o.background_factor, "cost of entries off the support / largest cost (Sec. 4.3)", 1.5, 1e3);
}

}  // namespace varimap
