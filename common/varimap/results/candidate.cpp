#include "varimap/results/candidate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace varimap {

double score_of(const Candidate& candidate) {
    return std::log(candidate.energy) + std::log(candidate.dirichlet) / 2 - candidate.relief;
}

bool is_mirrored(const Candidate& candidate) {
    // Parts of a wrong map may be reversed before they are mapped anew; of a mirrored one nearly all is.
    return candidate.reversed_mass > 0.6;
}

Confidence confidence_of(const std::vector<Candidate>& candidates) {
    constexpr double sure = 0.9;
    constexpr double detail = 0.05;  // what differs on less, a foot or an ear, is no other map
    Confidence result;
    if (candidates.empty()) return result;
    const Candidate& best = candidates.front();
    result.margin = 1;
    for (size_t k = 1; k < candidates.size(); ++k)
        if (!is_mirrored(candidates[k]) && candidates[k].moved_mass > detail)
            result.margin = std::min(result.margin, candidates[k].score - best.score);
    result.probability = 1 / (1 + std::exp(-(12 * result.margin + 6 * (best.relief - 0.6) -
                                             4 * std::log(std::max(best.dirichlet, 1.0)))));
    if (is_mirrored(best)) result.probability = 0;
    result.confident = result.probability >= sure;
    return result;
}

std::string doubt(const std::vector<Candidate>& candidates) {
    constexpr double strained = 1.6, unlike = 0.5, close = 0.1;
    const Confidence confidence = confidence_of(candidates);
    if (confidence.confident || candidates.empty()) return "";
    const Candidate& best = candidates.front();
    if (is_mirrored(best)) return "only mirrored maps were found";
    std::string why;
    const auto add = [&](const std::string& reason) { why += (why.empty() ? "" : "; ") + reason; };
    if (confidence.margin < close) add(fmt::format("another is only {:.1f}% worse", 100 * confidence.margin));
    if (best.dirichlet > strained)
        add(fmt::format("it is strained, with a Dirichlet energy of {:.2f}", best.dirichlet));
    if (best.relief < unlike) add(fmt::format("relief agrees by {:.2f} only", best.relief));
    return why.empty() ? "no one cue decides" : why;
}

std::string relation(const Candidate& candidate) {
    if (is_mirrored(candidate)) return "mirrored";
    if (candidate.moved_mass == 0) return "the best";
    return fmt::format("{:.0f}% of the surface elsewhere, turned by {:.0f} degrees",
                       100 * candidate.moved_mass, candidate.turn);
}

std::string origin(const Candidate& candidate) {
    std::string text = fmt::format("map {}", candidate.explored);
    if (candidate.self_map_A > 0)
        text += fmt::format(" after self-map {} of the source", candidate.self_map_A);
    if (candidate.self_map_B > 0)
        text += fmt::format(", then self-map {} of the target", candidate.self_map_B);
    return text;
}

}  // namespace varimap
