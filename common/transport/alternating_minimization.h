#pragma once

#include <functional>
#include <vector>

#include "common/transport/cost.h"
#include "common/transport/sinkhorn.h"

namespace varimap {

struct AlternationOptions {
    double tolerance = 1e-3;           ///< stop when the energy changes by less than this share (Alg. 1)
    int maximum_alternations = 30;
    double gamma_divisor = 300;        ///< gamma = largest instantiated cost / this
    double annealing_divisor = 100;    ///< the first solve of a level starts from largest cost / this, in steps of 3
    double marginal_tolerance = 1e-2;  ///< Sinkhorn stops at this L1 error of the row sums
    int sinkhorn_iterations = 1000;
    double support_threshold = 1e-2;   ///< entries below this share of their row's and column's mass do not spread
    double background_factor = 10;     ///< cost of entries that are not instantiated, times the largest cost
};

/// What one alternation did; passed to the observer.
struct Alternation {
    int iteration;
    double energy;  ///< Eq. (3) after both half-steps
    double gamma;
    SinkhornReport sinkhorn;
    int entries;
};

/// State of a level: the plan, the centres that belong to it, and the samples' own mean images.
struct Solution {
    Coupling plan;
    CentreStep step;
};

/// Kept entries to start from, one sorted list of columns per row; empty: the full problem (coarsest level).
using KeptEntries = std::vector<std::vector<int>>;

/// Alg. 1 at one level: from centres, alternately solves for the plan on a support that follows it (Sec. 4.3)
/// and relocates the centres, until the energy of Eq. (3) settles.
Solution minimize_alternatingly(const Side& X, const Side& Y, const Centres& start, const KeptEntries& kept,
                                const AlternationOptions& options,
                                const std::function<void(const Alternation&)>& observe);

}  // namespace varimap
