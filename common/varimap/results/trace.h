#pragma once

#include <vector>

namespace varimap {

/// One iteration of the alternating minimisation (Alg. 1).
struct TraceRow {
    int level = 0;      ///< index over diffusion and Euclidean levels together
    int euclidean = 0;  ///< 1 on Euclidean levels
    int iteration = 0;  ///< alternation within the level, from 0
    int samples_A = 0, samples_B = 0;
    int sinkhorn_iterations = 0;
    double entries = 0;         ///< instantiated entries of the plan
    double gamma = 0;           ///< entropic regularisation, units of the cost
    double energy = 0;          ///< Eq. (3) after both half-steps
    double marginal_error = 0;  ///< L1 distance of the row sums from the masses
};

/// In the order in which they were computed.
using Trace = std::vector<TraceRow>;

}  // namespace varimap
