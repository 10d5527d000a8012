#include "varimap/results/candidate.h"

#include <fmt/format.h>

#include <algorithm>

namespace varimap {

bool is_mirrored(const Candidate& candidate) {
    // A right map reads up to a tenth reversed on coarse levels, a mirrored one nearly all.
    return candidate.reversed_mass > 0.4;
}

Confidence confidence_of(const std::vector<Candidate>& candidates) {
    constexpr double least_margin = 0.015;
    constexpr double detail = 0.05;  // what differs on less, a foot or an ear, is no other map
    Confidence result;
    if (candidates.empty()) return result;
    const Candidate& best = candidates.front();
    result.margin = 1;
    for (size_t k = 1; k < candidates.size(); ++k) {
        if (is_mirrored(candidates[k])) continue;
        if (candidates[k].moved_mass > 0 && candidates[k].moved_mass <= detail) continue;
        result.margin = std::min(result.margin, candidates[k].score - best.score);
        result.levels_agree &= best.diffusion_energy <= candidates[k].diffusion_energy &&
                               best.euclidean_energy <= candidates[k].euclidean_energy;
    }
    result.confident = !is_mirrored(best) && result.levels_agree && result.margin >= least_margin;
    return result;
}

std::string relation(const Candidate& candidate) {
    if (is_mirrored(candidate)) return "mirrored";
    if (candidate.moved_mass == 0) return "the best";
    return fmt::format("{:.0f}% of the surface elsewhere, turned by {:.0f} degrees",
                       100 * candidate.moved_mass, candidate.turn);
}

}  // namespace varimap
