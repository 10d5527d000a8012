#pragma once

#include <vector>

namespace varimap {

/// What the other landmarks, pinned, say of a landmark.
struct LandmarkCheck {
    double distance = 0;     ///< along B, units of sqrt(area): from where they take it to where it was put
    double energy_fall = 0;  ///< by which share Eq. (3) falls without it, coarsely; negative: it rises
};

/// Which landmark the others contradict, from 0, or -1: the one with the largest distance, up to 0.2, times
/// energy fall, if that is large. Only one is named, because a wrong landmark makes right ones seem wrong,
/// too.
int contradicted_landmark(const std::vector<LandmarkCheck>& checks);

}  // namespace varimap
