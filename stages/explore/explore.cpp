#include "stages/explore/explore.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "stages/explore/candidate_maps.h"
#include "stages/explore/difference.h"
#include "stages/explore/doubtful_landmarks.h"
#include "stages/explore/finished_pool.h"
#include "stages/explore/landmark_spread.h"
#include "stages/explore/mirror_images.h"
#include "stages/explore/surface_comparison.h"
#include "stages/explore/turns.h"
#include "varimap/core/log.h"
#include "varimap/mesh/boundary.h"
#include "varimap/results/choice.h"

namespace varimap {

namespace {

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

/// Whether nothing else need be looked for than the map that landmarks lead to: it is plausible, not
/// strained, meets them (soft ones it may miss), and they decide it. Chosen by hand on half of the known
/// pairs.
bool landmarks_suffice(const Appraised& led, const PairContext& context) {
    constexpr double suffices = 0.995;
    return logged_plausibility(led.candidate) >= suffices && is_good(led.candidate, true) &&
           led.candidate.landmarks_missed == 0 && landmarks_span(context);
}

/// The first alone, which landmarks lead to. It is to be continued: solved for anew from the coarsest level,
/// at full resolution, landmarks may lead elsewhere.
Candidates led(std::vector<Appraised> list, const PairContext& context) {
    list.resize(1);
    return candidates_of(list, context);
}

/// What is found between A and the mirror image of B.
struct ByMirrorImages {
    std::vector<PooledMap> maps;  ///< mirrored back
    /// Of the best map between mirror images, if that tells that one is a left and the other a right one.
    double score = std::numeric_limits<double>::infinity();
};

/// One search for the maps of a pair. Keeps references.
class MapSearch {
  public:
    MapSearch(const PairContext& context, const ExploreParams& params, const OnDemand& ask)
        : context_(context),
          params_(params),
          ask_(ask),
          led_(led_by_landmarks(context, params)),
          appraisal_(context),
          finished_(context, params.quick_finishing(), appraisal_),
          self_maps_(context, ask.self_maps) {}

    Candidates run();

  private:
    /// Whether landmarks were given, and nothing is looked for unless where they lead is doubtful.
    bool only_if_needed() const { return params_.only_if_needed && !context_.landmarks().empty(); }
    std::optional<std::vector<Appraised>> found_by_landmarks_alone();
    std::vector<Appraised> quickly_found();
    std::vector<Appraised> found_by_one_exploration(const ExplorationProgress& coarse);
    ByMirrorImages found_by_mirror_images(const ExplorationProgress& coarse,
                                          const std::vector<Candidate>& found) const;
    std::vector<Appraised> thoroughly_found();
    std::vector<Appraised> with_turns(FinishedPool& finished) const;
    std::vector<Appraised> with_maps_from_axes(const std::vector<Appraised>& found);
    bool are_undisputed(const std::vector<Appraised>& led_first) const;

    const PairContext& context_;
    const ExploreParams& params_;
    const OnDemand& ask_;
    const std::vector<PooledMap> led_;  ///< where landmarks lead
    const Appraisal appraisal_;
    FinishedPool finished_;  ///< quickly
    LazySelfMaps self_maps_;
    std::vector<PooledMap> mirrored_back_;  ///< found between mirror images
    /// As in ByMirrorImages, or of the map between mirror images that the landmarks lead to.
    double mirrored_score_ = std::numeric_limits<double>::infinity();
    std::optional<BetterExchange> exchange_;
};

/// What landmarks lead to, finished just well enough to be judged; nothing where it is doubtful.
std::optional<std::vector<Appraised>> MapSearch::found_by_landmarks_alone() {
    finished_.add_new_of(led_);
    std::vector<Appraised> alone = finished_.appraised();
    const LandmarkDoubts doubts(context_, appraisal_, params_);
    mirrored_score_ = doubts.score_if_mirrored(alone.front());
    if (std::isfinite(mirrored_score_)) return {};
    if (is_isometry_of_sheets(alone.front().candidate, context_)) return alone;
    // Landmarks are named by their rows, which change where some are left out.
    if (context_.landmarks_left_out() == 0) exchange_ = doubts.better_exchange(alone.front());
    if (exchange_ || !landmarks_suffice(alone.front(), context_)) return {};
    return alone;
}

/// What most pairs need: one exploration, and maps finished just well enough to be told apart.
std::vector<Appraised> MapSearch::quickly_found() {
    const ExplorationProgress coarse = coarsely_explored(context_, params_.exploration, params_);
    std::vector<Appraised> list = found_by_one_exploration(coarse);
    if (!self_maps_.exist()) return list;
    ByMirrorImages mirrored = found_by_mirror_images(coarse, ratings(list));
    mirrored_back_ = std::move(mirrored.maps);
    mirrored_score_ = std::min(mirrored_score_, mirrored.score);
    finished_.add(mirrored_back_);
    return with_turns(finished_);
}

std::vector<Appraised> MapSearch::found_by_one_exploration(const ExplorationProgress& coarse) {
    std::vector<PooledMap> pool =
        pooled(led_, {explored(context_, coarse, params_.exploration, params_)}, context_);
    finished_.add_new_of(pool);
    std::vector<Appraised> list = finished_.appraised();
    if (!self_maps_.exist() ||
        (logged_plausibility(list.front().candidate) >= beyond_doubt && has_turned_rival(list)))
        return list;
    const size_t before = pool.size();
    if (is_nearly_isometric(list.front().candidate))
        self_maps_.add_compositions_with_B(pool, params_.composed);
    else
        self_maps_.add_compositions(pool, params_.composed);
    if (pool.size() == before) return list;
    finished_.add_new_of(pool);
    return finished_.appraised();
}

/// What is found, and what the best of it becomes, turned about axes on which it looks nearly the same.
std::vector<Appraised> MapSearch::with_turns(FinishedPool& finished) const {
    std::vector<Appraised> list = finished.appraised();
    std::vector<PooledMap> turned = turned_about_axes(list.front(), context_, appraisal_);
    if (!has_turned_rival(list)) {
        std::vector<PooledMap> halves = turned_by_halves(list.front(), context_, appraisal_);
        std::ranges::move(halves, std::back_inserter(turned));
    }
    if (turned.empty()) return list;
    finished.add(turned);
    return finished.appraised();
}

/// `found`: the best first. Where shapes differ much either search may miss the best map: a horse and a cow
/// fit better by 3 as mirror images, though both are their own. Then what was found is mirrored back, if the
/// choice is not sure. Shapes that are much alike are told apart by less.
ByMirrorImages MapSearch::found_by_mirror_images(const ExplorationProgress& coarse,
                                                 const std::vector<Candidate>& found) const {
    // Chosen by hand. Bodies in other poses, which are their own mirror images, differ by .2, and fit by -36
    // at best; left bones and hands fit right ones by -39.
    constexpr double better = 0.35, much_alike = -36, unlike = -32;
    if (is_own_mirror_image(context_)) return {};
    const bool sure = confidence_of(found).confident;
    if (sure && found.front().score > unlike) return {};  // too far from what could tell them apart
    // A left and a right one are isometric as mirror images, so that the right map has little energy.
    const std::size_t most = sure ? 3 : std::numeric_limits<std::size_t>::max();
    const MirrorImages mirror(context_, coarse, params_, params_.quick_finishing(), most);
    const double score = mirror.best().score, as_they_are = found.front().score;
    log("as mirror images: score {:.2f}, as they are {:.2f}", score, as_they_are);
    const bool are_much_alike = score < much_alike;
    if (score + better > as_they_are || (!are_much_alike && sure)) return {};
    auto [maps, are_their_own] = mirror.mirrored_back();
    ByMirrorImages result{std::move(maps)};
    if (are_much_alike && !are_their_own) result.score = score;
    return result;
}

/// Starts that end at tips, or by which coarse levels cost least, may miss the right map: of a mug, which has
/// no limbs but a handle, all had the handle on the wall.
std::vector<Appraised> MapSearch::with_maps_from_axes(const std::vector<Appraised>& found) {
    constexpr int count = 2;
    int known = 0;
    for (const Appraised& one : found) known = std::max(known, one.candidate.explored);
    std::vector<PooledMap> maps = from_axes(context_, count, params_);
    for (PooledMap& map : maps) map.origin.explored += known;
    finished_.add(maps);
    std::vector<Appraised> list = finished_.appraised();
    return list.front().candidate.explored > known ? with_turns(finished_) : list;
}

/// For shapes that differ much, of which energies of coarse levels prefer wrong maps: explorations with the
/// area bound and with exact areas, that give more maps and more alike ones a chance, more compositions, and
/// maps finished with care. Chosen by hand on two hippopotamuses.
std::vector<Appraised> MapSearch::thoroughly_found() {
    std::vector<PooledMap> known = led_;
    known.insert(known.end(), mirrored_back_.begin(), mirrored_back_.end());
    std::vector<std::vector<PooledMap>> explorations;
    for (const double factor : {1.0, 0.5}) {
        ExplorationOptions options = params_.exploration;
        options.area_bound = std::max(1.0, factor * options.area_bound);
        options.tip_starts = 3 * options.tip_starts / 2;
        options.axes_maps = 4;
        options.coarse *= 3;
        options.distinct /= 2;
        options.seed += int(explorations.size());
        explorations.push_back(explored(context_, options, params_));
    }
    FinishingOptions options = params_.finishing;
    options.alternation = for_comparison(params_.alternation, params_.alternation.area_bound);
    options.euclidean_rounds = options.ironing.maximum_rounds;
    options.most += 4;
    std::vector<PooledMap> pool = pooled(known, explorations, context_);
    self_maps_.add_compositions(pool, 2 * params_.composed);
    FinishedPool finished(context_, options, appraisal_);
    finished.add_new_of(pool);
    return self_maps_.exist() ? with_turns(finished) : finished.appraised();
}

/// Whether the first is what landmarks lead to, and neither another map nor one between mirror images scores
/// better: else both are shown.
bool MapSearch::are_undisputed(const std::vector<Appraised>& led_first) const {
    return led_first.front().candidate.explored == 0 && confidence_of(ratings(led_first)).margin >= 0 &&
           !std::isfinite(mirrored_score_);
}

Candidates MapSearch::run() {
    if (only_if_needed())
        if (auto alone = found_by_landmarks_alone()) return led(std::move(*alone), context_);
    std::vector<Appraised> list = quickly_found();
    const bool good = is_good(list.front().candidate, only_if_needed());
    if (!good) {
        const Candidate& best = list.front().candidate;
        log("the best of these maps is not good (plausible by {:.2f}, Dirichlet energy {:.2f}): looking "
            "further",
            plausibility(best), best.dirichlet);
        list = thoroughly_found();
    } else if (self_maps_.exist() && !confidence_of(ratings(list)).confident) {
        list = with_maps_from_axes(list);
    }
    if (exchange_) warn_of(*exchange_, list.front().candidate, context_);
    if (good && only_if_needed() && are_undisputed(list)) {
        log("none of {} maps is better than where the landmarks lead", list.size());
        return led(std::move(list), context_);
    }
    for (Appraised& one : list)
        one.candidate.mirror_gain = std::max(0.0, one.candidate.score - mirrored_score_);
    if (ask_.surfaces)
        list = compared_on_surfaces(std::move(list), context_, params_.quick_finishing(), ask_.surfaces);
    return with_previews(list, context_);
}

/// So many landmarks decide; all that can be wrong is that they fit mirror images.
void warn_of_mirrored_landmarks(const PairContext& context) {
    if (is_own_mirror_image(context)) return;
    const PairHandedness handedness(context.A().surface, context.B().surface);
    if (landmarks_look_mirrored(context, handedness.are_opposite()))
        warn(
            "the landmarks fit mirror images of the surfaces: if one is a left and the other a right "
            "one, {}",
            mirror_advice(context));
}

}  // namespace

Candidates explore(const PairContext& context, const ExploreParams& params, const OnDemand& ask) {
    if (params.only_if_needed && context.landmarks_given() > params.few_landmarks) {
        log("{} landmarks: nothing else is looked for", context.landmarks_given());
        warn_of_mirrored_landmarks(context);
        return {};
    }
    return MapSearch(context, params, ask).run();
}

}  // namespace varimap
