#pragma once

#include <vector>

#include "varimap/landmarks/vertex_list.h"
#include "varimap/multilevel/pair_context.h"
#include "varimap/results/landmark_check.h"

namespace varimap {

/// Per landmark: the coarse levels, up to the first with 100 samples, are solved once more with all other
/// landmarks, and what becomes of this one is compared with the map that has them all. A landmark that the
/// others contradict is carried far away, and the energy falls. Here landmarks are pinned, also where they
/// are soft in the map: what a wrong one costs shows best so. None are checked where there are more than 100,
/// which is said: the time is linear in their number.
std::vector<LandmarkCheck> check_landmarks(const PairContext& context, const AlternationOptions& options);

/// Warns where landmarks, vertices by their numbers, fit far better with the source's taken for the target's
/// and the reverse (distances_fit). Not of points, nor where a repair has changed numbers.
void warn_of_exchanged_columns(const Landmarks& landmarks, const PairContext& context);

/// Logs what becomes of each landmark, and warns of the one that the others contradict, if any.
void report(const std::vector<LandmarkCheck>& checks);

}  // namespace varimap
