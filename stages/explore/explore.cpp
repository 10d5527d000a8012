#include "stages/explore/explore.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "stages/explore/appraisal.h"
#include "stages/explore/exchanged_landmarks.h"
#include "stages/explore/pool.h"
#include "varimap/core/error.h"
#include "varimap/core/log.h"
#include "varimap/core/parallel.h"
#include "varimap/core/timing.h"
#include "varimap/mesh/input_locator.h"
#include "varimap/results/read_out.h"

namespace varimap {

namespace {

/// What exploration found; mirrored maps only where there are no others.
std::vector<PooledMap> explored(Exploration& exploration) {
    const Timer timer("exploration");
    const std::vector<Trial> trials = exploration.run();
    std::vector<PooledMap> pool;
    for (const Trial& trial : trials)
        if (pool.empty() || !trial.is_mirrored())
            pool.push_back(
                {exploration.images(trial), {.explored = int(pool.size()) + 1, .energy = trial.energy()}});
    return pool;
}

PointPairs on_inputs(const PointMap& map, const Surface& from, const InputLocator& to) {
    PointPairs pairs(map.size());
    parallel_for_each_index(map.size(), std::size_t(64), [&](std::size_t v) {
        pairs[v] = {from.on_input[v], to(map[v])};
    });
    return pairs;
}

Correspondences correspondences(const MapPair& maps, const Surface& A, const Surface& B) {
    const InputLocator on_A(A), on_B(B);
    return {on_inputs(maps.A_to_B, A, on_B), on_inputs(maps.B_to_A, B, on_A)};
}

/// Per vertex of the file of `from` its image on the file of `to`, linear on the mesh's faces.
PointMap preview(const PointMap& map, const Surface& from, const Surface& to) {
    const InputLocator locate(to);
    const TriangleMesh normals{vertex_normals(to.mesh), to.mesh.faces};
    PointMap result(from.on_mesh.size());
    parallel_for_each_index(result.size(), std::size_t(64), [&](std::size_t v) {
        const SurfacePoint& at = from.on_mesh[v];
        if (at.face < 0) return;
        Vec3 x = Vec3::Zero(), normal = Vec3::Zero();
        for (int k = 0; k < 3; ++k) {
            const SurfacePoint& image = map[std::size_t(from.mesh.faces(at.face, k))];
            x += at.barycentric[k] * position(to.mesh, image);
            normal += at.barycentric[k] * position(normals, image);
        }
        result[v] = locate(x, normal);
    });
    return to_file(std::move(result), from, to);
}

/// Self-maps of both surfaces of a pair, asked for once, where they are needed.
class LazySelfMaps {
  public:
    LazySelfMaps(const PairContext& context, const std::function<SelfMaps()>& ask)
        : context_(context), ask_(ask) {}
    bool exist() const { return bool(ask_); }

    /// Adds what the first `most` maps become with them.
    void compose(std::vector<PooledMap>& pool, int most) {
        if (!exist()) return;
        if (!images_) {
            const SelfMaps found = ask_();
            images_ = {images_of(found.A, context_.A().surface), images_of(found.B, context_.B().surface)};
        }
        varimap::compose(pool, most, images_->A, images_->B, context_);
    }

  private:
    struct Images {
        std::vector<VertexImages> A, B;
    };
    const PairContext& context_;
    const std::function<SelfMaps()>& ask_;
    std::optional<Images> images_;
};

/// The map that landmarks lead to; none without landmarks.
std::vector<PooledMap> led_by_landmarks(const PairContext& context, const ExploreParams& params) {
    if (context.landmarks().empty()) return {};
    Exploration exploration(context, params.exploration, params.alternation, params.ironing);
    const Trial trial = exploration.follow_landmarks();
    return {{exploration.images(trial), {.explored = 0, .energy = trial.energy()}}};
}

/// `led`, if there is such a map, and those that explorations find.
std::vector<PooledMap> pooled(const PairContext& context, const std::vector<ExplorationOptions>& explorations,
                              const ExploreParams& params, const std::vector<PooledMap>& led) {
    std::vector<PooledMap> pool = led;
    int found = 0;
    for (const ExplorationOptions& options : explorations) {
        Exploration exploration(context, options, params.alternation, params.ironing);
        for (PooledMap& map : explored(exploration)) {
            map.origin.explored = ++found;
            add_if_new(pool, std::move(map), context);
        }
    }
    return pool;
}

/// A finished map and what is known of it.
struct Appraised {
    FinishedMap map;
    Candidate candidate;
};

/// The best first, mirrored ones last, and what each is to the best.
std::vector<Appraised> ordered(std::vector<Appraised> list, const PairContext& context) {
    // Where landmarks lead is given up only for what is better by more than scores err. Chosen by hand on
    // half of the known pairs; no choice of the other half depends on it.
    constexpr double preference = 0.5;
    const auto rank = [](const Candidate& c) {
        return std::pair(is_mirrored(c), c.score - (c.explored == 0 ? preference : 0));
    };
    std::stable_sort(list.begin(), list.end(), [&](const Appraised& a, const Appraised& b) {
        return rank(a.candidate) < rank(b.candidate);
    });
    list.front().candidate.moved_mass = list.front().candidate.turn = 0;
    for (std::size_t k = 1; k < list.size(); ++k)
        compare(list.front().map, list[k].map, context, list[k].candidate);
    return list;
}

/// Finishes the maps of a pool that grows.
class Finishing {
  public:
    Finishing(const PairContext& context, FinishingOptions options, const Appraisal& appraisal)
        : context_(context), options_(std::move(options)), appraisal_(appraisal) {}

    /// Those that have joined the pool since the last time, but for those that become what is there already.
    void finish(const std::vector<PooledMap>& pool) {
        const size_t before = origins_.size();
        if (pool.size() == before) return;
        const Timer timer("finishing");
        std::vector<MapStart> starts;
        for (size_t n = before; n < pool.size(); ++n) {
            starts.push_back(
                [&images = pool[n].images](const LevelPair& level) { return matching_of(images, level); });
            origins_.push_back(pool[n].origin);
        }
        for (FinishedMap& map : varimap::finish(context_, appraisal_, starts, options_, maps_)) {
            map.start += int(before);
            measured_.push_back(origins_[std::size_t(map.start)]);
            appraisal_.measure(map, measured_.back());
            maps_.push_back(std::move(map));
        }
    }

    /// In order.
    std::vector<Appraised> appraised() const;

  private:
    const PairContext& context_;
    FinishingOptions options_;
    const Appraisal& appraisal_;
    std::vector<Candidate> origins_;  ///< of all starts so far
    std::vector<FinishedMap> maps_;
    std::vector<Candidate> measured_;  ///< what is known of each by itself
};

std::vector<Appraised> Finishing::appraised() const {
    std::vector<Appraised> list;
    for (std::size_t n = 0; n < maps_.size(); ++n) list.push_back({maps_[n], measured_[n]});
    return ordered(std::move(list), context_);
}

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
/// image, and is a map, of which it would be no wonder otherwise that it is worse. One that was turned by 79
/// degrees, and bad, hid from a person that was turned by 180 that it was.
bool has_turned_rival(const std::vector<Appraised>& list) {
    constexpr double most = 0.5, torn = 0.1, about = 110;
    return std::any_of(list.begin(), list.end(), [](const Appraised& one) {
        return one.candidate.moved_mass > most && one.candidate.turn > about &&
               one.candidate.reversed_mass < torn;
    });
}

/// What most pairs need: one exploration, and maps finished just well enough to be told apart. In `finishing`
/// the map that landmarks lead to may be finished already.
std::vector<Appraised> quickly_found(const PairContext& context, const ExploreParams& params,
                                     const std::vector<PooledMap>& led, Finishing& finishing,
                                     LazySelfMaps& self_maps) {
    // A wrong map may look as good as that where the right one is the same, turned about, and was not found.
    constexpr double beyond_doubt = 0.985;
    std::vector<PooledMap> pool = pooled(context, {params.exploration}, params, led);
    finishing.finish(pool);
    std::vector<Appraised> list = finishing.appraised();
    if (!self_maps.exist() ||
        (logged_plausibility(list.front().candidate) >= beyond_doubt && has_turned_rival(list)))
        return list;
    const size_t explored = pool.size();
    self_maps.compose(pool, params.composed);
    if (pool.size() == explored) return list;
    finishing.finish(pool);
    return finishing.appraised();
}

/// For shapes that differ much, of which energies of coarse levels prefer wrong maps: explorations with the
/// area bound and with exact areas, that give more maps and more alike ones a chance, more compositions, and
/// maps finished with care. Chosen by hand on two hippopotamuses.
std::vector<Appraised> thoroughly_found(const PairContext& context, const ExploreParams& params,
                                        const std::vector<PooledMap>& led, const Appraisal& appraisal,
                                        LazySelfMaps& self_maps) {
    std::vector<ExplorationOptions> explorations;
    for (const double factor : {1.0, 0.5}) {
        ExplorationOptions options = params.exploration;
        options.area_bound = std::max(1.0, factor * options.area_bound);
        options.tip_starts = 3 * options.tip_starts / 2;
        options.axes_maps = 4;
        options.coarse *= 3;
        options.distinct /= 2;
        options.seed += int(explorations.size());
        explorations.push_back(options);
    }
    FinishingOptions options = params.finishing;
    options.alternation = for_comparison(params.alternation, params.alternation.area_bound);
    options.euclidean_rounds = options.ironing.maximum_rounds;
    options.most += 4;
    std::vector<PooledMap> pool = pooled(context, explorations, params, led);
    self_maps.compose(pool, 2 * params.composed);
    Finishing finishing(context, options, appraisal);
    finishing.finish(pool);
    return finishing.appraised();
}

/// What is known of the maps, without them.
std::vector<Candidate> ratings(const std::vector<Appraised>& list) {
    std::vector<Candidate> candidates;
    for (const Appraised& one : list) candidates.push_back(one.candidate);
    return candidates;
}

Candidates candidates_of(const std::vector<Appraised>& list, const PairContext& context) {
    Candidates found;
    found.list = ratings(list);
    for (const Appraised& one : list)
        found.maps.push_back(correspondences(one.map.maps, context.A().surface, context.B().surface));
    return found;
}

Candidates with_previews(const std::vector<Appraised>& list, const PairContext& context) {
    constexpr std::size_t shown = 3;
    Candidates found = candidates_of(list, context);
    if (confidence_of(found.list).confident) return found;
    for (std::size_t k = 0; k < std::min(list.size(), shown); ++k)
        found.previews.push_back(preview(list[k].map.maps.B_to_A, context.B().surface, context.A().surface));
    return found;
}

/// Those that may be the right map as well as the best: not mirrored, and not much worse. Of 23 pairs of
/// animals, of which two had another order on the surfaces, it was the second that was the best there, worse
/// by 2.9 once.
std::vector<Appraised> finalists(std::vector<Appraised> list) {
    constexpr double gap = 4;
    constexpr std::size_t most = 3;
    const double worst = list.front().candidate.score + gap;
    std::erase_if(list, [&](const Appraised& one) {
        return is_mirrored(one.candidate) || one.candidate.score > worst;
    });
    if (list.size() > most) list.resize(most);
    return list;
}

/// Maps of sketches in the order of what becomes of them on the surfaces that were sketched, where more
/// shows. They stay the maps of the sketches, and so do their scores where none is better than the first by
/// more than scores err: of a hippopotamus and a lion the turned map was, by .3. Relaxing the maps changed no
/// order.
std::vector<Appraised> compared_on(const PairContext& surfaces, const std::vector<Appraised>& list,
                                   const PairContext& sketches, const ExploreParams& params) {
    constexpr double better = 0.8;
    const Timer timer("comparison on the surfaces");
    std::vector<Appraised> compared = finalists(list);
    std::vector<MapStart> starts;
    for (const Appraised& one : compared) {
        const Correspondences points =
            correspondences(one.map.maps, sketches.A().surface, sketches.B().surface);
        starts.push_back([at = at_vertices(points, surfaces.A().surface, surfaces.B().surface)](
                             const LevelPair& level) { return matching_of(at, level); });
    }
    const Appraisal appraisal(surfaces);
    const std::vector<MapPair> maps = solved(surfaces, appraisal, starts, quick_finishing(params));
    for (std::size_t k = 0; k < compared.size(); ++k) {
        Candidate& candidate = compared[k].candidate;
        const double on_sketches = candidate.score;
        appraisal.measure_roughly(maps[k], candidate);
        log("{}: score {:.2f} on the surfaces, {:.2f} on sketches", origin(candidate), candidate.score,
            on_sketches);
    }
    const double first = compared.front().candidate.score;
    const bool another_is_better = std::any_of(compared.begin(), compared.end(), [&](const Appraised& one) {
        return one.candidate.score + better < first;
    });
    return another_is_better ? ordered(std::move(compared), sketches) : list;
}

/// Whether maps are compared on these surfaces in seconds: not where thin walls or --full-resolution keep
/// many vertices.
bool are_quick(const PairContext& surfaces) {
    constexpr int most = 10'000;
    return std::max(surfaces.A().surface.mesh.vertex_count(), surfaces.B().surface.mesh.vertex_count()) <=
           most;
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

/// "1 and 3", "1 with 3, 2 with 4".
std::string in_words(const Exchange& exchange) {
    std::string words;
    for (const auto& [i, j] : exchange)
        words += fmt::format("{}{} {} {}", words.empty() ? "" : ", ", i + 1,
                             exchange.size() == 1 ? "and" : "with", j + 1);
    return words;
}

/// Warns where the map that landmarks lead to would be far more probable with two or more of them exchanged:
/// with left and right exchanged, the only map that meets all landmarks and mirrors nothing has the front of
/// a body on its back, and is hardly strained. Asked only where relief agrees less than it does on right maps
/// of shapes in other poses, since it costs half a second.
void warn_of_exchanged_landmarks(const Candidate& led, const PairContext& context, const Appraisal& appraisal,
                                 const ExploreParams& params) {
    constexpr double alike = 0.9, much = 3, plausible = 0.9;
    if (led.relief > alike) return;
    const Exchange exchange = likely_exchange(context);
    if (exchange.empty()) return;
    const Timer timer("exchanged landmarks");
    const PairContext other(context.A(), context.B(), exchanged(context.landmarks(), exchange),
                            context.landmark_weight());
    Finishing finishing(other, quick_finishing(params), appraisal);
    finishing.finish(led_by_landmarks(other, params));
    const Candidate found = finishing.appraised().front().candidate;
    log("landmarks {} exchanged: score {:.2f}, as they are {:.2f}", in_words(exchange), found.score,
        led.score);
    if (is_mirrored(found) || plausibility(found) < plausible || found.score + much > led.score) return;
    warn(
        "landmarks {} look exchanged: with their partners exchanged the map is far more probable; are they "
        "left and right?",
        in_words(exchange));
}

/// The first alone, which landmarks lead to. It is to be continued: solved for anew from the coarsest level,
/// at full resolution, landmarks may lead elsewhere.
Candidates led(std::vector<Appraised> list, const PairContext& context) {
    list.resize(1);
    return candidates_of(list, context);
}

}  // namespace

bool landmarks_are_apart(const PairContext& context) {
    constexpr double far = 0.3;  // units of sqrt(area); chosen by hand on people
    constexpr int enough = 3;
    const std::vector<int>& landmarks = context.landmarks_A();
    const RowMatrix distance = distances_from_each(context.graph_A(), landmarks);
    std::vector<int> apart;
    for (int k = 0; k < int(landmarks.size()); ++k)
        if (std::all_of(apart.begin(), apart.end(),
                        [&](int other) { return distance(other, landmarks[std::size_t(k)]) > far; }))
            apart.push_back(k);
    return int(apart.size()) >= enough;
}

Candidates find_self_maps(const PairContext& context, const ExploreParams& params) {
    constexpr double another = 0.1;  // share of the surface that a self-map moves; chosen by hand
    ExplorationOptions options = params.exploration;
    options.area_bound = 1;  // the surface has the areas it has
    options.distinct = 0.4;
    options.random_starts *= 2;
    options.candidates = 4;
    options.last_samples = 400;  // rougher self-maps composed are no good
    Exploration exploration(context, options, params.alternation, params.ironing);
    const std::vector<PooledMap> pool = explored(exploration);
    const Surface& surface = context.A().surface;
    const FinishedMap same{0, {points_at_vertices(surface.mesh), points_at_vertices(surface.mesh)}, 0};
    Candidates found;
    for (const PooledMap& map : pool) {
        if (difference(map.images, identity(surface), surface, surface) < another) continue;
        const FinishedMap rough{
            0,
            {images_at(map.images.A_to_B, surface.mesh), images_at(map.images.B_to_A, surface.mesh)},
            map.origin.energy};
        Candidate candidate = map.origin;
        candidate.score = std::log(map.origin.energy / pool.front().origin.energy);
        compare(same, rough, context, candidate);
        found.list.push_back(candidate);
        found.maps.push_back(correspondences(rough.maps, surface, surface));
    }
    return found;
}

SelfMaps find_self_maps_of_both(const PairContext& pair, const ExploreParams& params) {
    const Timer timer("self-maps");
    return {find_self_maps({pair.A(), pair.A(), {}}, params),
            find_self_maps({pair.B(), pair.B(), {}}, params)};
}

Candidates explore(const PairContext& context, const ExploreParams& params, const OnDemand& ask) {
    // Chosen by hand on half of the known pairs: nothing else is looked for where the map that landmarks lead
    // to is as plausible, not strained, and they decide it.
    constexpr double suffices = 0.995;
    // Above .9, from which on choices are called sure: of a dog onto a lion a limb was wrong, by .92.
    constexpr double decided = 0.95;
    const bool if_needed = params.only_if_needed && !context.landmarks().empty();
    if (if_needed && int(context.landmarks().size()) > params.few_landmarks) {
        log("{} landmarks: nothing else is looked for", context.landmarks().size());
        return {};
    }
    const std::vector<PooledMap> led_there = led_by_landmarks(context, params);
    const Appraisal appraisal(context);
    Finishing finishing(context, quick_finishing(params), appraisal);
    if (if_needed) {
        finishing.finish(led_there);
        std::vector<Appraised> alone = finishing.appraised();
        const Candidate& there = alone.front().candidate;
        warn_of_exchanged_landmarks(there, context, appraisal, params);
        if (logged_plausibility(there) >= suffices && is_good(there, true) && landmarks_are_apart(context))
            return led(std::move(alone), context);
    }
    LazySelfMaps self_maps(context, ask.self_maps);
    std::vector<Appraised> list = quickly_found(context, params, led_there, finishing, self_maps);
    if (!is_good(list.front().candidate, if_needed)) {
        log("the best of these maps is not good (plausible by {:.2f}, Dirichlet energy {:.2f}): looking "
            "further",
            plausibility(list.front().candidate), list.front().candidate.dirichlet);
        list = thoroughly_found(context, params, led_there, appraisal, self_maps);
    } else if (if_needed && list.front().candidate.explored == 0 && !is_disputed(list)) {
        log("none of {} maps is better than where the landmarks lead", list.size());
        return led(std::move(list), context);
    }
    if (ask.surfaces && finalists(list).size() > 1 && confidence_of(ratings(list)).probability < decided) {
        const PairContext surfaces = ask.surfaces();
        if (are_quick(surfaces)) list = compared_on(surfaces, list, context, params);
    }
    return with_previews(list, context);
}

}  // namespace varimap
