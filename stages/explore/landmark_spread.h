#pragma once

#include "varimap/multilevel/pair_context.h"

namespace varimap {

// What landmarks decide by where they lie on A.

/// How many of them are far from each other. Fewer than three, or several at the tip of a finger, leave the
/// rest of a body to turn or twist, and a twisted one may look as plausible as the right map.
int landmarks_apart(const PairContext& context);

/// Whether three that are far from each other do not lie in a line: both ends of a shaft and a point between
/// them leave it to turn or twist.
bool landmarks_span(const PairContext& context);

/// Whether a similarity that mirrors takes four or more of them to their partners in space, and one that does
/// not hardly does: of bodies in other postures neither does. `opposed`: the surfaces are of opposite
/// handedness (PairHandedness), so that the one is the other.
bool landmarks_look_mirrored(const PairContext& context, bool opposed);

}  // namespace varimap
