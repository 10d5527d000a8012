#pragma once

#include "varimap/multilevel/matching.h"
#include "varimap/surface/surface.h"

namespace varimap {

// How much two maps differ.

/// Degrees of the rotation between two maps from which on the one is turned about against the other.
inline constexpr double turned_about = 110;

/// Share of a surface whose vertices two maps take to places farther apart than `elsewhere`.
double share_elsewhere(const Points& a, const Points& b, const Surface& from, double elsewhere);

/// Share of both surfaces on which two maps differ by more than 0.15 of sqrt(area).
double difference(const VertexImages& a, const VertexImages& b, const Surface& A, const Surface& B);

}  // namespace varimap
