#include "varimap/results/candidate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace varimap {

double strain(const Candidate& candidate) {
    return std::log(std::max(candidate.dirichlet, 1.0));
}

ScoreParts score_parts(const Candidate& candidate) {
    const int missed = candidate.landmarks_missed > 1 ? candidate.landmarks_missed : 0;
    return {120 * candidate.stretch, -25 * candidate.alignment, -20 * candidate.relief, 3 * strain(candidate),
            5. * missed};
}

double score_of(const Candidate& candidate) {
    const ScoreParts parts = score_parts(candidate);
    return parts.stretch + parts.alignment + parts.relief + parts.strain + parts.landmarks;
}

bool is_mirrored(const Candidate& candidate) {
    // Parts of a wrong map may be reversed before they are mapped anew; of a mirrored one nearly all is.
    return candidate.reversed_mass > 0.6;
}

std::string relation(const Candidate& candidate) {
    if (is_mirrored(candidate)) return "mirrored";
    if (candidate.moved_mass == 0) return "the best";
    return fmt::format("{:.0f}% of the surface elsewhere, turned by {:.0f} degrees",
                       100 * candidate.moved_mass, candidate.turn);
}

std::string origin(const Candidate& candidate) {
    std::string text =
        candidate.explored == 0 ? "where the landmarks lead" : fmt::format("map {}", candidate.explored);
    if (candidate.mirrored_back) {
        text += " of the mirror image, mirrored back";
    } else {
        if (candidate.self_map_A > 0)
            text += fmt::format(" after self-map {} of the source", candidate.self_map_A);
        if (candidate.self_map_B > 0)
            text += fmt::format(", then self-map {} of the target", candidate.self_map_B);
    }
    if (candidate.turned_about_axis) text += ", turned about an axis";
    if (candidate.turned_by_half) text += ", turned by a half";
    return text;
}

}  // namespace varimap
