#include "stages/explore/explore.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "stages/explore/candidate_maps.h"
#include "stages/explore/difference.h"
#include "stages/explore/finished_pool.h"
#include "stages/explore/landmark_spread.h"
#include "stages/explore/mirror_images.h"
#include "stages/explore/surface_comparison.h"
#include "stages/explore/turns.h"
#include "varimap/core/log.h"
#include "varimap/core/timing.h"
#include "varimap/mesh/boundary.h"
#include "varimap/multilevel/exchanged_landmarks.h"
#include "varimap/results/choice.h"
#include "varimap/results/landmark_words.h"

namespace varimap {

namespace {

FinishingOptions quick_finishing(const ExploreParams& params) {
    FinishingOptions finishing = params.finishing;
    finishing.alternation = for_comparison(params.alternation, params.alternation.area_bound);
    // Chosen by hand on half of the known pairs: most energies move by a hundredth.
    finishing.alternation.tolerance = std::max(finishing.alternation.tolerance, 1e-2);
    finishing.alternation.sinkhorn_iterations = std::min(finishing.alternation.sinkhorn_iterations, 20);
    return finishing;
}

double logged_plausibility(const Candidate& best) {
    const double found = is_mirrored(best) ? 0 : plausibility(best);
    log("{} is plausible by {:.3f} (Dirichlet energy {:.3f}, relief {:.3f})",
        best.explored == 0 ? "where the landmarks lead" : "the best map", found, best.dirichlet, best.relief);
    return found;
}

/// Whether the best map has been compared with one that is turned about: it gives most of the surface another
/// image, and is a map that is not worse by far, of which it would be no wonder otherwise that it is worse.
/// One that was turned by 79 degrees, and bad, hid from a person that was turned by 180 that it was, one with
/// a score that was worse by 18 from a robot.
bool has_turned_rival(const std::vector<Appraised>& list) {
    constexpr double most = 0.5, torn = 0.1, far = 12;
    const double best = list.front().candidate.score;
    return std::any_of(list.begin(), list.end(), [&](const Appraised& one) {
        return one.candidate.moved_mass > most && one.candidate.turn > turned_about &&
               one.candidate.reversed_mass < torn && one.candidate.score < best + far;
    });
}

/// A wrong map may look as good as that where the right one is the same, turned about, and was not found.
constexpr double beyond_doubt = 0.985;

/// Whether the surfaces are so much alike that both have the same maps onto themselves.
bool is_nearly_isometric(const Candidate& best) {
    // Chosen by hand; all of 38 pairs below that keep their maps and probabilities.
    constexpr double strained = 1.1;
    return !is_mirrored(best) && plausibility(best) >= beyond_doubt && best.dirichlet < strained;
}

/// What most pairs need: one exploration, and maps finished just well enough to be told apart. In `finished`
/// the map that landmarks lead to may be finished already.
std::vector<Appraised> quickly_found(const PairContext& context, const ExplorationProgress& coarse,
                                     const ExploreParams& params, const std::vector<PooledMap>& led,
                                     FinishedPool& finished, LazySelfMaps& self_maps) {
    std::vector<PooledMap> pool =
        pooled(led, {explored(context, coarse, params.exploration, params)}, context);
    finished.add_new_of(pool);
    std::vector<Appraised> list = finished.appraised();
    if (!self_maps.exist() ||
        (logged_plausibility(list.front().candidate) >= beyond_doubt && has_turned_rival(list)))
        return list;
    const size_t before = pool.size();
    if (is_nearly_isometric(list.front().candidate))
        self_maps.add_compositions_with_B(pool, params.composed);
    else
        self_maps.add_compositions(pool, params.composed);
    if (pool.size() == before) return list;
    finished.add_new_of(pool);
    return finished.appraised();
}

/// What is found, and what the best of it becomes, turned about axes on which it looks nearly the same.
std::vector<Appraised> with_turns(FinishedPool& finished, const PairContext& context,
                                  const Appraisal& appraisal) {
    std::vector<Appraised> list = finished.appraised();
    std::vector<PooledMap> turned = turned_about_axes(list.front(), context, appraisal);
    if (!has_turned_rival(list)) {
        std::vector<PooledMap> halves = turned_by_halves(list.front(), context, appraisal);
        std::ranges::move(halves, std::back_inserter(turned));
    }
    if (turned.empty()) return list;
    finished.add(turned);
    return finished.appraised();
}

/// Whether the surfaces fit better as mirror images of each other.
struct ByMirrorImages {
    std::vector<PooledMap> maps;  ///< mirrored back
    /// Of the best map between mirror images, if that tells that one is a left and the other a right one.
    double score = std::numeric_limits<double>::infinity();
};
/// `found`: the best first. Where shapes differ much either search may miss the best map: a horse and a cow
/// fit better by 3 as mirror images, though both are their own. Then what was found is mirrored back, if the
/// choice is not sure. Shapes that are much alike are told apart by less.
ByMirrorImages found_by_mirror_images(const PairContext& context, const ExplorationProgress& coarse,
                                      const ExploreParams& params, const std::vector<Candidate>& found) {
    // Chosen by hand. Bodies in other poses, which are their own mirror images, differ by .2, and fit by -36
    // at best; left bones and hands fit right ones by -39.
    constexpr double better = 0.35, much_alike = -36, unlike = -32;
    const bool sure = confidence_of(found).confident;
    if (sure && found.front().score > unlike) return {};  // too far from what could tell them apart
    // A left and a right one are isometric as mirror images, so that the right map has little energy.
    const std::size_t most = sure ? 3 : std::numeric_limits<std::size_t>::max();
    const MirrorImages mirror(context, coarse, params, quick_finishing(params), most);
    const double score = mirror.best().score, as_they_are = found.front().score;
    log("as mirror images: score {:.2f}, as they are {:.2f}", score, as_they_are);
    const bool are_much_alike = score < much_alike;
    if (score + better > as_they_are || (!are_much_alike && sure)) return {};
    ByMirrorImages result{mirror.mirrored_back()};
    if (are_much_alike) result.score = score;
    return result;
}

/// For shapes that differ much, of which energies of coarse levels prefer wrong maps: explorations with the
/// area bound and with exact areas, that give more maps and more alike ones a chance, more compositions, and
/// maps finished with care. Chosen by hand on two hippopotamuses.
std::vector<Appraised> thoroughly_found(const PairContext& context, const ExploreParams& params,
                                        const std::vector<PooledMap>& led, const Appraisal& appraisal,
                                        LazySelfMaps& self_maps) {
    std::vector<std::vector<PooledMap>> explorations;
    for (const double factor : {1.0, 0.5}) {
        ExplorationOptions options = params.exploration;
        options.area_bound = std::max(1.0, factor * options.area_bound);
        options.tip_starts = 3 * options.tip_starts / 2;
        options.axes_maps = 4;
        options.coarse *= 3;
        options.distinct /= 2;
        options.seed += int(explorations.size());
        explorations.push_back(explored(context, options, params));
    }
    FinishingOptions options = params.finishing;
    options.alternation = for_comparison(params.alternation, params.alternation.area_bound);
    options.euclidean_rounds = options.ironing.maximum_rounds;
    options.most += 4;
    std::vector<PooledMap> pool = pooled(led, explorations, context);
    self_maps.add_compositions(pool, 2 * params.composed);
    FinishedPool finished(context, options, appraisal);
    finished.add_new_of(pool);
    return self_maps.exist() ? with_turns(finished, context, appraisal) : finished.appraised();
}

/// Whether another map scores better than the first, to which landmarks lead: then both are shown.
bool is_disputed(const std::vector<Appraised>& list) {
    return confidence_of(ratings(list)).margin < 0;
}

/// Whether the best map that was quickly found may do. Chosen by hand on half of the known pairs: fewer maps
/// are wrong with landmarks, but a limb may be, which strains them.
bool is_good(const Candidate& best, bool has_landmarks) {
    constexpr double plausible = 0.9, plausible_with_landmarks = 0.75, strained = 1.25;
    if (!has_landmarks) return plausibility(best) >= plausible;
    return plausibility(best) >= plausible_with_landmarks && best.dirichlet < strained;
}

/// Whether landmarks lay a sheet onto another without straining it, and two of them are far apart: as in the
/// plane, that leaves no other map, though relief may say nothing. Chosen by hand on leaves and cloth.
bool is_isometry_of_sheets(const Candidate& there, const PairContext& context) {
    constexpr double isometric = 1.1;
    return there.dirichlet < isometric && !is_mirrored(there) && is_sheet(context.A().surface.mesh) &&
           is_sheet(context.B().surface.mesh) && landmarks_apart(context) >= 2;
}

/// Of the map that the landmarks of the context lead to, on the first Euclidean level.
double rough_score_led(const PairContext& context, const Appraisal& appraisal, const ExploreParams& params) {
    const std::vector<PooledMap> led = led_by_landmarks(context, params);
    const std::vector<MapStart> starts{start_of(led.front())};
    return rough_score(cues_when_solved(context, appraisal, starts, quick_finishing(params)).front());
}

/// The best of the maps that the landmarks of the context lead to.
Candidate best_led(const PairContext& context, const Appraisal& appraisal, const ExploreParams& params) {
    FinishedPool finished(context, quick_finishing(params), appraisal);
    finished.add_new_of(led_by_landmarks(context, params));
    return finished.appraised().front().candidate;
}

/// The score of the best of the maps between mirror images of the surfaces that the landmarks lead to.
double score_between_mirror_images(const PairContext& context, const ExploreParams& params) {
    const PairContext mirror = with_mirror_image(context);
    const double score = best_led(mirror, Appraisal(mirror), params).score;
    log("as mirror images, by the landmarks: score {:.2f}", score);
    return score;
}

/// The same where the landmarks look mirrored and it is much better than that of the map that they lead to as
/// they are: probably one of the surfaces is a left and the other a right one. Infinity else.
double score_if_mirrored(const Appraised& led, const PairContext& context, const Appraisal& appraisal,
                         const ExploreParams& params) {
    constexpr double much = 2, none = std::numeric_limits<double>::infinity();
    if (!landmarks_look_mirrored(context, appraisal.handedness().are_opposite())) return none;
    const Timer timer("mirror images");
    const double score = score_between_mirror_images(context, params);
    log("the landmarks look mirrored; as they are: score {:.2f}", led.candidate.score);
    return score + much < led.candidate.score ? score : none;
}

/// An exchange of landmarks by which the map that they lead to becomes far more probable.
struct BetterExchange {
    Exchange exchange;
    double score;        ///< of that map
    bool fits_mirrored;  ///< as they are, the landmarks fit mirror images of the surfaces even better
};

/// With left and right exchanged, the only map that meets all landmarks and mirrors nothing has the front of
/// a body on its back, and is hardly strained. Asked only where relief agrees less than it does on right maps
/// of shapes in other poses, and taken to its end only where the map is no worse roughly, since it costs half
/// a second.
std::optional<BetterExchange> better_exchange(const Appraised& led, const PairContext& context,
                                              const Appraisal& appraisal, const ExploreParams& params) {
    constexpr double alike = 0.9, much = 3, plausible = 0.9;
    // Of 19 pairs with right landmarks, all maps with exchanged ones were worse by 1.3 and more then, and by
    // 2.4 and more in the end.
    constexpr double roughly_worse = 1;
    // Bodies that are their own mirror images, whose landmarks are exchanged, fit as well both ways.
    constexpr double clear = 0.5;
    if (led.candidate.relief > alike) return {};
    const Exchange exchange = likely_exchange(context);
    if (exchange.empty()) return {};
    const Timer timer("exchanged landmarks");
    const PairContext other(context.A(), context.B(), exchanged(context.landmarks(), exchange),
                            context.landmark_weight());
    if (rough_score_led(other, appraisal, params) > led.map.rough_scores.at(1) + roughly_worse) return {};
    const Candidate found = best_led(other, appraisal, params);
    log("landmarks {} exchanged: score {:.2f}, as they are {:.2f}", exchanged_in_words(exchange), found.score,
        led.candidate.score);
    if (is_mirrored(found) || plausibility(found) < plausible || found.score + much > led.candidate.score)
        return {};
    return BetterExchange{exchange, found.score,
                          score_between_mirror_images(context, params) < found.score - clear};
}

/// Unless a map was found that meets the landmarks as they are, and fits about as well: of a body with many
/// legs, right landmarks may lead to a map with legs exchanged.
void warn_of(const BetterExchange& better, const Candidate& best, const PairContext& context) {
    constexpr double about = 1.5;  // half of what an exchange must gain
    if (best.score < better.score + about) return;
    if (better.fits_mirrored)
        warn(
            "the landmarks fit mirror images: if one of the surfaces is a left and the other a right one, "
            "{}; "
            "with landmarks {} exchanged the map would be more probable, too, but less so",
            mirror_advice(context), exchanged_in_words(better.exchange));
    else
        warn(
            "landmarks {} look exchanged: with their partners exchanged the map is far more probable; are "
            "they left and right? If they are right, one of the surfaces may be a mirror image of what it "
            "should be: {}",
            exchanged_in_words(better.exchange), mirror_advice(context));
}

/// Whether nothing else need be looked for than the map that landmarks lead to: it is plausible, not
/// strained, and they decide it. Chosen by hand on half of the known pairs.
bool landmarks_suffice(const Appraised& led, const PairContext& context) {
    constexpr double suffices = 0.995;
    return logged_plausibility(led.candidate) >= suffices && is_good(led.candidate, true) &&
           landmarks_span(context);
}

/// The first alone, which landmarks lead to. It is to be continued: solved for anew from the coarsest level,
/// at full resolution, landmarks may lead elsewhere.
Candidates led(std::vector<Appraised> list, const PairContext& context) {
    list.resize(1);
    return candidates_of(list, context);
}

}  // namespace

Candidates explore(const PairContext& context, const ExploreParams& params, const OnDemand& ask) {
    const bool if_needed = params.only_if_needed && !context.landmarks().empty();
    if (if_needed && int(context.landmarks().size()) > params.few_landmarks) {
        log("{} landmarks: nothing else is looked for", context.landmarks().size());
        if (landmarks_look_mirrored(context,
                                    PairHandedness(context.A().surface, context.B().surface).are_opposite()))
            warn(
                "the landmarks fit mirror images of the surfaces: if one is a left and the other a right "
                "one, {}",
                mirror_advice(context));
        return {};
    }
    const std::vector<PooledMap> led_there = led_by_landmarks(context, params);
    const Appraisal appraisal(context);
    FinishedPool finished(context, quick_finishing(params), appraisal);
    std::optional<BetterExchange> exchange;
    double mirrored_score = std::numeric_limits<double>::infinity();
    if (if_needed) {
        finished.add_new_of(led_there);
        std::vector<Appraised> alone = finished.appraised();
        const bool of_sheets = is_isometry_of_sheets(alone.front().candidate, context);
        mirrored_score = score_if_mirrored(alone.front(), context, appraisal, params);
        const bool mirrored = std::isfinite(mirrored_score);
        if (!of_sheets && !mirrored) exchange = better_exchange(alone.front(), context, appraisal, params);
        if (!mirrored && (of_sheets || (!exchange && landmarks_suffice(alone.front(), context))))
            return led(std::move(alone), context);
    }
    LazySelfMaps self_maps(context, ask.self_maps);
    const ExplorationProgress coarse = coarsely_explored(context, params.exploration, params);
    std::vector<Appraised> list = quickly_found(context, coarse, params, led_there, finished, self_maps);
    ByMirrorImages mirrored;
    if (self_maps.exist()) {
        mirrored = found_by_mirror_images(context, coarse, params, ratings(list));
        finished.add(mirrored.maps);
        list = with_turns(finished, context, appraisal);
        mirrored_score = std::min(mirrored_score, mirrored.score);
    }
    const bool good = is_good(list.front().candidate, if_needed);
    if (!good) {
        log("the best of these maps is not good (plausible by {:.2f}, Dirichlet energy {:.2f}): looking "
            "further",
            plausibility(list.front().candidate), list.front().candidate.dirichlet);
        std::vector<PooledMap> known = led_there;
        known.insert(known.end(), mirrored.maps.begin(), mirrored.maps.end());
        list = thoroughly_found(context, params, known, appraisal, self_maps);
    }
    if (exchange) warn_of(*exchange, list.front().candidate, context);
    if (good && if_needed && list.front().candidate.explored == 0 && !is_disputed(list) &&
        !std::isfinite(mirrored_score)) {
        log("none of {} maps is better than where the landmarks lead", list.size());
        return led(std::move(list), context);
    }
    for (Appraised& one : list)
        one.candidate.mirror_gain = std::max(0.0, one.candidate.score - mirrored_score);
    if (ask.surfaces)
        list = compared_on_surfaces(std::move(list), context, quick_finishing(params), ask.surfaces);
    return with_previews(list, context);
}

}  // namespace varimap
