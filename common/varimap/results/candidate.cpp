#include "varimap/results/candidate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace varimap {

namespace {

constexpr double alignment_worth = 25, relief_worth = 20, stretch_worth = 120, strain_worth = 3;

double strain(const Candidate& candidate) {
    return std::log(std::max(candidate.dirichlet, 1.0));
}

}  // namespace

double score_of(const Candidate& candidate) {
    return stretch_worth * candidate.stretch - alignment_worth * candidate.alignment -
           relief_worth * candidate.relief + strain_worth * strain(candidate);
}

bool is_mirrored(const Candidate& candidate) {
    // Parts of a wrong map may be reversed before they are mapped anew; of a mirrored one nearly all is.
    return candidate.reversed_mass > 0.6;
}

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

/// How probable it is that a rival is the right map rather than the best one: as much as not where both are
/// as good, three quarters with a few rivals; less for one that differs on a limb alone.
double doubt_by(const Candidate& rival, const Candidate& best) {
    constexpr double even = 0.75, whole = 0.25;
    return even * relative_probability(rival, best) * std::min(1.0, rival.moved_mass / whole);
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

/// Of the first candidate's rivals the one that is most probable; 0 without any.
double most_probable_rival(const std::vector<Candidate>& candidates) {
    double most = 0;
    for (std::size_t k = 1; k < candidates.size(); ++k)
        if (is_rival(candidates[k]))
            most = std::max(most, relative_probability(candidates[k], candidates.front()));
    return most;
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

Confidence confidence_of(const std::vector<Candidate>& candidates, std::optional<InTheEnd> finished) {
    constexpr double sure = 0.9;
    if (candidates.empty()) return {};
    const Candidate& best = candidates.front();
    double margin = 10, doubt = 0;
    for (size_t k = 1; k < candidates.size(); ++k) {
        const Candidate& rival = candidates[k];
        if (!is_rival(rival)) continue;
        margin = std::min(margin, rival.score - best.score);
        doubt = std::max(doubt, doubt_by(rival, best));
    }
    double probability = is_mirrored(best)
                             ? 0
                             : plausibility(best) * plausibility_of_reversed(best.reversed_mass) *
                                   plausibility_of_handedness(best.mirror_gain) * (1 - doubt);
    if (finished) {
        if (!finished->many_handles) probability *= plausibility_when_finished(finished->dirichlet);
        probability *= plausibility_when_covered(finished->coverage);
        if (finished->inside_out) probability /= 2;  // as many are mirror images as not
        if (finished->twist >= doubtful_twist) probability /= 2;
        if (finished->components_astray) probability /= 2;
    }
    return {margin, probability, probability >= sure};
}

std::string probability_in_words(const Confidence& confidence) {
    if (confidence.probability < .01) return "right with a probability below 0.01";
    if (confidence.probability >= .995) return "right with a probability above 0.99";
    // Rounded down, so that what is not sure does not look as if it were.
    return fmt::format("right with a probability of {:.2f}",
                       std::floor(100 * confidence.probability + 1e-9) / 100);
}

std::string doubt(const std::vector<Candidate>& candidates, std::optional<InTheEnd> finished) {
    constexpr double strained = 1.3, strained_in_the_end = 1.2, unlike = 0.6, close = 0.135, mirrored = 0.05,
                     covered = 0.92;
    const Confidence confidence = confidence_of(candidates, finished);
    if (confidence.confident || candidates.empty()) return "";
    const Candidate& best = candidates.front();
    if (is_mirrored(best)) return "only mirrored maps were found";
    std::string why;
    const auto add = [&](const std::string& reason) { why += (why.empty() ? "" : "; ") + reason; };
    if (fits_mirrored(best)) add("the surfaces fit better as mirror images");
    if (const double rival = most_probable_rival(candidates); rival > close)
        add(rival < 1 ? fmt::format("another is {:.0f}% as probable", 100 * rival)
                      : std::string("another is as probable"));
    if (std::any_of(candidates.begin(), candidates.end(),
                    [](const Candidate& one) { return one.turned_about_axis; }))
        add("turned about an axis it looks nearly the same");
    if (finished && finished->inside_out) add("one of the surfaces is inside out");
    if (finished && finished->components_astray) add("components lie on others than their partners");
    if (finished && finished->twist >= doubtful_twist)
        add(fmt::format("finished, it twists a part by {:.0f} degrees", finished->twist));
    if (finished && finished->coverage < covered)
        add(fmt::format("finished, it leaves out {:.0f}% of a surface", 100 * (1 - finished->coverage)));
    if (finished && !finished->many_handles && finished->dirichlet > strained_in_the_end)
        add(fmt::format("finished, it is strained, with a Dirichlet energy of {:.2f}", finished->dirichlet));
    else if (best.dirichlet > strained)
        add(fmt::format("its sketch is strained, with a Dirichlet energy of {:.2f}", best.dirichlet));
    if (best.reversed_mass > mirrored)
        add(fmt::format("{:.0f}% of its sketch is mirrored", 100 * best.reversed_mass));
    if (best.relief < unlike) add(fmt::format("on sketches relief agrees by {:.2f} only", best.relief));
    if (why.empty())
        return fmt::format("no number is bad by itself: Dirichlet energy {:.2f}, relief agrees by {:.2f}",
                           finished ? finished->dirichlet : best.dirichlet, best.relief);
    return why;
}

std::string decided_by(const std::vector<Candidate>& candidates) {
    const Candidate *best = nullptr, *rival = nullptr;
    for (const Candidate& candidate : candidates) {
        if (!best)
            best = &candidate;
        else if (is_rival(candidate) && (!rival || candidate.score < rival->score))
            rival = &candidate;
    }
    if (!rival) return "";
    const struct {
        const char* name;
        double gain;  // in score, of the best map over its rival
    } cues[] = {{"alignment", alignment_worth * (best->alignment - rival->alignment)},
                {"relief", relief_worth * (best->relief - rival->relief)},
                {"stretch", stretch_worth * (rival->stretch - best->stretch)},
                {"strain", strain_worth * (strain(*rival) - strain(*best))}};
    constexpr double little = 0.1;
    std::string with, against;
    for (const auto& [name, gain] : cues) {
        std::string& side = gain > 0 ? with : against;
        if (std::abs(gain) > little) side += (side.empty() ? "" : " and ") + std::string(name);
    }
    if (with.empty()) return "no cue by much";
    return with + (against.empty() ? "" : ", against " + against);
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
