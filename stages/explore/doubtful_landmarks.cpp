#include "stages/explore/doubtful_landmarks.h"

#include <limits>

#include "stages/explore/landmark_spread.h"
#include "stages/explore/mirror_images.h"
#include "stages/explore/pool.h"
#include "varimap/core/log.h"
#include "varimap/core/timing.h"
#include "varimap/results/choice.h"
#include "varimap/results/landmark_words.h"

namespace varimap {

namespace {

/// Of the map that the landmarks of the context lead to, on the first Euclidean level.
double rough_score_led(const PairContext& context, const Appraisal& appraisal, const ExploreParams& params) {
    const std::vector<PooledMap> led = led_by_landmarks(context, params);
    const std::vector<MapStart> starts{start_of(led.front())};
    return rough_score(cues_when_solved(context, appraisal, starts, params.quick_finishing()).front());
}

/// The best of the maps that the landmarks of the context lead to.
Candidate best_led(const PairContext& context, const Appraisal& appraisal, const ExploreParams& params) {
    FinishedPool finished(context, params.quick_finishing(), appraisal);
    finished.add_new_of(led_by_landmarks(context, params));
    return finished.appraised().front().candidate;
}

}  // namespace

void warn_of(const BetterExchange& better, const Candidate& best, const PairContext& context) {
    constexpr double about = 1.5;  // half of what an exchange must gain
    if (best.score < better.score + about) return;
    if (better.fits_mirrored)
        warn(
            "the landmarks fit mirror images: if one of the surfaces is a left and the other a right one, "
            "{}; with landmarks {} exchanged the map would be more probable, too, but less so",
            mirror_advice(context), exchanged_in_words(better.exchange));
    else
        warn(
            "landmarks {} look exchanged: with their partners exchanged the map is far more probable; are "
            "they left and right? If they are right, one of the surfaces may be a mirror image of what it "
            "should be: {}",
            exchanged_in_words(better.exchange), mirror_advice(context));
}

double LandmarkDoubts::score_between_mirror_images() const {
    const PairContext mirror = with_mirror_image(context_);
    const double score = best_led(mirror, Appraisal(mirror), params_).score;
    log("as mirror images, by the landmarks: score {:.2f}", score);
    return score;
}

double LandmarkDoubts::score_if_mirrored(const Appraised& led) const {
    constexpr double much = 2, none = std::numeric_limits<double>::infinity();
    if (is_own_mirror_image(context_)) return none;
    if (!landmarks_look_mirrored(context_, appraisal_.handedness().are_opposite())) return none;
    const Timer timer("mirror images");
    const double score = score_between_mirror_images();
    log("the landmarks look mirrored; as they are: score {:.2f}", led.candidate.score);
    return score + much < led.candidate.score ? score : none;
}

/// With left and right exchanged, the only map that meets all landmarks and mirrors nothing has the front of
/// a body on its back, and is hardly strained. Asked only where relief agrees less than it does on right maps
/// of shapes in other poses, and taken to its end only where the map is no worse roughly, since it costs half
/// a second.
std::optional<BetterExchange> LandmarkDoubts::better_exchange(const Appraised& led) const {
    constexpr double alike = 0.9, much = 3, plausible = 0.9;
    // Of 19 pairs with right landmarks, all maps with exchanged ones were worse by 1.3 and more then, and by
    // 2.4 and more in the end.
    constexpr double roughly_worse = 1;
    // Bodies that are their own mirror images, whose landmarks are exchanged, fit as well both ways.
    constexpr double clear = 0.5;
    if (led.candidate.relief > alike) return {};
    const Exchange exchange = likely_exchange(context_);
    if (exchange.empty()) return {};
    const Timer timer("exchanged landmarks");
    const PairContext other(context_.A(), context_.B(), exchanged(context_.landmarks(), exchange),
                            context_.landmark_weight());
    if (rough_score_led(other, appraisal_, params_) > led.map.rough_scores.at(1) + roughly_worse) return {};
    const Candidate found = best_led(other, appraisal_, params_);
    log("landmarks {} exchanged: score {:.2f}, as they are {:.2f}", exchanged_in_words(exchange), found.score,
        led.candidate.score);
    if (is_mirrored(found) || plausibility(found) < plausible || found.score + much > led.candidate.score)
        return {};
    return BetterExchange{exchange, found.score, score_between_mirror_images() < found.score - clear};
}

}  // namespace varimap
