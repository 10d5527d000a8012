#pragma once

#include <vector>

#include "varimap/multilevel/pair_context.h"
#include "varimap/results/candidates.h"

namespace varimap {

/// Logs what is known of each candidate, how sure the choice of the first is and what it was decided by.
/// Warns where the first is mirrored, where the surfaces fit better as mirror images, or else where the
/// choice is not sure, and says what to do then. There is at least one candidate; `has_landmarks`: some were
/// given.
void report(const Candidates& found, bool has_landmarks, const PairContext& context);

/// Logs the energy of each self-map and its relation to the identity.
void report_self_maps(const std::vector<Candidate>& self_maps);

}  // namespace varimap
