#include "stages/explore/report.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "stages/explore/mirror_images.h"
#include "varimap/core/log.h"
#include "varimap/results/choice.h"

namespace varimap {

namespace {

/// ", first at vertex 12 of the source: candidate 1 has it at vertex 34 of the target, 2 at 56"; or "".
std::string where_to_tell(const TellingVertex& told) {
    if (told.images.empty()) return "";
    std::string text =
        fmt::format(", first at vertex {} of the source: candidate 1 has it at vertex {} of the target",
                    told.source, told.images.front());
    for (std::size_t k = 1; k < told.images.size(); ++k)
        text += fmt::format(", {} at {}", k + 1, told.images[k]);
    return text;
}

void log_candidates(const std::vector<Candidate>& candidates) {
    for (size_t k = 0; k < candidates.size(); ++k)
        log("candidate {} ({}): energy {:.6g}, Dirichlet energy {:.3f}, relief {:.3f}, alignment {:.3f}, "
            "stretch {:.3f}, {} landmarks missed, score {:.2f}, {:.1f}% reversed; {}",
            k + 1, origin(candidates[k]), candidates[k].energy, candidates[k].dirichlet, candidates[k].relief,
            candidates[k].alignment, candidates[k].stretch, candidates[k].landmarks_missed,
            candidates[k].score, 100 * candidates[k].reversed_mass, relation(candidates[k]));
    log("the first is {}", probability_in_words(confidence_of(candidates)));
    if (const std::string cue = decided_by(candidates); !cue.empty())
        log("decided against its best rival by {}", cue);
}

void warn_of_doubts(const Candidates& found, bool has_landmarks, const PairContext& context) {
    const std::vector<Candidate>& candidates = found.list;
    if (is_mirrored(candidates.front()))
        warn(
            "only mirrored maps were found; are the surfaces of opposite handedness (--mirror)? look at "
            "candidates.png");
    else if (fits_mirrored(candidates.front()))
        warn(
            "the surfaces fit better as mirror images of each other: if one is a left and the other a right "
            "one, {}; else {}",
            mirror_advice(context), has_landmarks ? "look at the landmarks" : "give landmarks");
    else if (!confidence_of(candidates).confident)
        warn(
            "the choice among the candidates is not sure ({}): look at candidates.png, {}or give "
            "{}landmarks{}",
            doubt(candidates), candidates.size() > 1 ? "try --candidate 2, " : "",
            has_landmarks ? "more " : "", where_to_tell(found.telling));
}

}  // namespace

void report(const Candidates& found, bool has_landmarks, const PairContext& context) {
    log_candidates(found.list);
    warn_of_doubts(found, has_landmarks, context);
}

void report_self_maps(const std::vector<Candidate>& self_maps) {
    for (size_t k = 0; k < self_maps.size(); ++k)
        log("self-map {}: energy {:.2f} times the identity's, {}", k + 1, std::exp(self_maps[k].score),
            relation(self_maps[k]));
}

}  // namespace varimap
