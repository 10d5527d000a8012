#include "varimap/results/choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace varimap {

namespace {

// Chosen by hand on generated families and on half of the known pairs of animals, people and apes.

/// How probable a rival is, compared with the best one, by their scores. Of surfaces that look nearly the
/// same turned about an axis these say half as much: of five teeth and bones whose turned maps were better,
/// by .4 to 3.2, one was wrong, by 2.4.
double relative_probability(const Candidate& rival, const Candidate& best) {
    constexpr double worth_of_turned = 0.5;
    const double worth = rival.turned_about_axis || best.turned_about_axis ? worth_of_turned : 1;
    return std::exp(-worth * std::max(0.0, rival.score - best.score));
}

/// How probable it is that a map which looked right at low resolution is right, by the Dirichlet energy that
/// it has in the end: right maps of animals as unlike as a cow and a fox have 1.2 at most, those on which
/// limbs are exchanged mostly more.
double plausibility_when_finished(double dirichlet) {
    // Fitted by eye to 60 pairs of generated families, of which it divides 3 wrong maps from all right ones
    // but one: a few that are as strained as wrong ones are right all the same.
    constexpr double even = 1.3, scale = 0.03, least = 0.25;
    return least + (1 - least) / (1 + std::pow(std::max(1.0, dirichlet) / even, 1 / scale));
}

/// The same by how much of the surfaces it reaches: right maps of animals of other species leave out up to a
/// tenth of one, a tail that the other has not; a rod onto a spring, wrong, and a person with a hat onto one
/// without a head, whose arm went into the chest, a fifth and a tenth. Chosen by hand on these.
double plausibility_when_covered(double coverage) {
    constexpr double even = 0.88, scale = 0.012;
    return 1 / (1 + std::exp((even - coverage) / scale));
}

/// The same of any map that looks right, by the share of the surfaces that it reverses: of 250 right maps of
/// generated pairs, animals, people and apes one has more than a tenth; a person of whom it was a sixth was
/// turned. It is no reason to look further, which found nothing better.
double plausibility_of_reversed(double reversed_mass) {
    constexpr double even = 0.15, scale = 0.02;
    return 1 / (1 + std::exp((reversed_mass - even) / scale));
}

/// How probable it is that the surfaces are not a left and a right one, by how much better they fit as mirror
/// images. Chosen by hand on a femur and a hand, which gained 1.6 and 1.4.
double plausibility_of_handedness(double mirror_gain) {
    constexpr double even = 0.85, scale = 0.12;
    return 1 / (1 + std::exp((mirror_gain - even) / scale));
}

/// Whether it is another answer than the first.
bool is_rival(const Candidate& candidate) {
    constexpr double detail = 0.05;  // what differs on less, a foot or an ear, is no other map
    return !is_mirrored(candidate) && candidate.moved_mass > detail;
}

}  // namespace

bool fits_mirrored(const Candidate& best) {
    return plausibility_of_handedness(best.mirror_gain) < 0.5;
}

bool reverses_much(const Candidate& candidate) {
    return plausibility_of_reversed(candidate.reversed_mass) < 0.5;
}

double plausibility(const Candidate& candidate) {
    constexpr double relief = 0.5, dirichlet = 0.2;  // at which it is even
    return 1 / (1 + std::exp(-14 * (candidate.relief - relief) + 4 * (strain(candidate) - dirichlet)));
}

namespace {

struct Cause {
    double factor = 1;    ///< by which it makes the first less probable
    std::string words{};  ///< that are said where the choice is not sure; "": nothing worth saying
};

/// How probable it is that one of the rivals is the right map rather than the best one: as much as not where
/// one is as good, three quarters with a few; less by one that differs on a limb alone. Of a lump with five
/// bumps four rivals, none of them close, hid the right map.
Cause rivals(const std::vector<Candidate>& candidates) {
    constexpr double even = 0.75, whole = 0.25, close = 0.135;
    const Candidate& best = candidates.front();
    double nearest = 0, together = 0;
    for (std::size_t k = 1; k < candidates.size(); ++k) {
        if (!is_rival(candidates[k])) continue;
        const double relative = relative_probability(candidates[k], best);
        nearest = std::max(nearest, relative);
        together += relative * std::min(1.0, candidates[k].moved_mass / whole);
    }
    Cause cause{1 - even * std::min(1.0, together)};
    if (nearest == 1)
        cause.words = "another is as probable";
    else if (nearest > close)
        cause.words = fmt::format("another is {:.0f}% as probable", 100 * nearest);
    else if (together > close)
        cause.words = fmt::format("others together are {:.0f}% as probable", 100 * together);
    return cause;
}

Cause turned_about_axis(const std::vector<Candidate>& candidates) {
    const bool any = std::any_of(candidates.begin(), candidates.end(),
                                 [](const Candidate& one) { return one.turned_about_axis; });
    return {1, any ? "turned about an axis it looks nearly the same" : ""};
}

bool is_strained(const FinishedQuality& finished) {
    constexpr double strained = 1.2;
    return !finished.many_handles && finished.dirichlet > strained;
}

/// What the finished map says against itself.
std::vector<Cause> causes_when_finished(const FinishedQuality& finished) {
    constexpr double covered = 0.92;
    std::vector<Cause> causes;
    // As many as not are mirror images.
    if (finished.inside_out) causes.push_back({0.5, "one of the surfaces is inside out"});
    if (finished.components_astray) causes.push_back({0.5, "components lie on others than their partners"});
    if (finished.twist >= doubtful_twist)
        causes.push_back({0.5, fmt::format("finished, it twists a part by {:.0f} degrees", finished.twist)});
    causes.push_back(
        {plausibility_when_covered(finished.coverage),
         finished.coverage < covered
             ? fmt::format("finished, it leaves out {:.0f}% of a surface", 100 * (1 - finished.coverage))
             : ""});
    if (!finished.many_handles)
        causes.push_back({plausibility_when_finished(finished.dirichlet),
                          is_strained(finished)
                              ? fmt::format("finished, it is strained, with a Dirichlet energy of {:.2f}",
                                            finished.dirichlet)
                              : ""});
    return causes;
}

/// What its sketch says against it.
std::vector<Cause> causes_of_sketch(const Candidate& best, bool strain_was_said) {
    constexpr double strained = 1.3, unlike = 0.6, mirrored = 0.05;
    return {{plausibility(best),
             !strain_was_said && best.dirichlet > strained
                 ? fmt::format("its sketch is strained, with a Dirichlet energy of {:.2f}", best.dirichlet)
                 : ""},
            {plausibility_of_reversed(best.reversed_mass),
             best.reversed_mass > mirrored
                 ? fmt::format("{:.0f}% of its sketch is mirrored", 100 * best.reversed_mass)
                 : ""},
            {1, best.relief < unlike ? fmt::format("on sketches relief agrees by {:.2f} only", best.relief)
                                     : ""}};
}

/// All that makes the first of the candidates less than certain, in the order in which it is said.
std::vector<Cause> causes_of_doubt(const std::vector<Candidate>& candidates,
                                   const std::optional<FinishedQuality>& finished) {
    const Candidate& best = candidates.front();
    if (is_mirrored(best)) return {{0, "only mirrored maps were found"}};
    std::vector<Cause> causes{{plausibility_of_handedness(best.mirror_gain),
                               fits_mirrored(best) ? "the surfaces fit better as mirror images" : ""},
                              rivals(candidates),
                              turned_about_axis(candidates)};
    const auto append = [&](std::vector<Cause> more) {
        std::move(more.begin(), more.end(), std::back_inserter(causes));
    };
    if (finished) append(causes_when_finished(*finished));
    append(causes_of_sketch(best, finished && is_strained(*finished)));
    return causes;
}

double probability_of(const std::vector<Cause>& causes) {
    double probability = 1;
    for (const Cause& cause : causes) probability *= cause.factor;
    return probability;
}

constexpr double sure = 0.9;

/// Score of the best rival, less the first's.
double margin(const std::vector<Candidate>& candidates) {
    double margin = 10;
    for (std::size_t k = 1; k < candidates.size(); ++k)
        if (is_rival(candidates[k]))
            margin = std::min(margin, candidates[k].score - candidates.front().score);
    return margin;
}

}  // namespace

Confidence confidence_of(const std::vector<Candidate>& candidates, std::optional<FinishedQuality> finished) {
    if (candidates.empty()) return {};
    const double probability = probability_of(causes_of_doubt(candidates, finished));
    return {margin(candidates), probability, probability >= sure};
}

std::string probability_in_words(const Confidence& confidence) {
    if (confidence.probability < .01) return "right with a probability below 0.01";
    if (confidence.probability >= .995) return "right with a probability above 0.99";
    // Rounded down, so that what is not sure does not look as if it were.
    return fmt::format("right with a probability of {:.2f}",
                       std::floor(100 * confidence.probability + 1e-9) / 100);
}

std::string doubt(const std::vector<Candidate>& candidates, std::optional<FinishedQuality> finished) {
    if (candidates.empty()) return "";
    const std::vector<Cause> causes = causes_of_doubt(candidates, finished);
    if (probability_of(causes) >= sure) return "";
    std::string why;
    for (const Cause& cause : causes)
        if (!cause.words.empty()) why += (why.empty() ? "" : "; ") + cause.words;
    if (!why.empty()) return why;
    const Candidate& best = candidates.front();
    return fmt::format("no number is bad by itself: Dirichlet energy {:.2f}, relief agrees by {:.2f}",
                       finished ? finished->dirichlet : best.dirichlet, best.relief);
}

std::string decided_by(const std::vector<Candidate>& candidates) {
    const Candidate* rival = nullptr;
    for (std::size_t k = 1; k < candidates.size(); ++k)
        if (is_rival(candidates[k]) && (!rival || candidates[k].score < rival->score)) rival = &candidates[k];
    if (!rival) return "";
    const ScoreParts of_best = score_parts(candidates.front()), of_rival = score_parts(*rival);
    const struct {
        const char* name;
        double gain;  // in score, of the best map over its rival
    } cues[] = {{"alignment", of_rival.alignment - of_best.alignment},
                {"relief", of_rival.relief - of_best.relief},
                {"stretch", of_rival.stretch - of_best.stretch},
                {"strain", of_rival.strain - of_best.strain},
                {"landmarks", of_rival.landmarks - of_best.landmarks}};
    constexpr double little = 0.1;
    std::string with, against;
    for (const auto& [name, gain] : cues) {
        std::string& side = gain > 0 ? with : against;
        if (std::abs(gain) > little) side += (side.empty() ? "" : " and ") + std::string(name);
    }
    if (with.empty()) return "no cue by much";
    return with + (against.empty() ? "" : ", against " + against);
}

}  // namespace varimap
