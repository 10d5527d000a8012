#include "stages/explore/surface_comparison.h"

#include <algorithm>

#include "stages/explore/candidate_maps.h"
#include "varimap/core/log.h"
#include "varimap/core/timing.h"
#include "varimap/results/choice.h"

namespace varimap {

namespace {

/// Whether maps are compared on these surfaces in seconds: not where thin walls or --full-resolution keep
/// many vertices.
bool are_quick(const PairContext& surfaces) {
    constexpr int most = 10'000;
    return std::max(surfaces.A().surface.mesh.vertex_count(), surfaces.B().surface.mesh.vertex_count()) <=
           most;
}

/// Those that may be the right map as well as the best: not much worse, and not reversing more than right
/// maps do (of a horse and a lion a map that reversed a fifth took the place of the right one). Of 23 pairs
/// of animals, of which two had another order on the surfaces, it was the second that was the best there,
/// worse by 2.9 once.
std::vector<Appraised> finalists(const std::vector<Appraised>& list) {
    constexpr double gap = 4;
    constexpr std::size_t most = 3;
    const double worst = list.front().candidate.score + gap;
    std::vector<Appraised> chosen;
    for (const Appraised& one : list)
        if (chosen.empty() ||
            (chosen.size() < most && !reverses_much(one.candidate) && one.candidate.score <= worst))
            chosen.push_back(one);
    return chosen;
}

/// Gives maps of sketches the cues of what becomes of them on the surfaces that were sketched, and the mean
/// of both scores: either errs, and by itself it lost right maps that the other was sure of. Relaxing the
/// maps there changed no order.
void rate_on(const PairContext& surfaces, std::vector<Appraised>& maps, const PairContext& sketches,
             const FinishingOptions& options) {
    const Timer timer("comparison on the surfaces");
    std::vector<MapStart> starts;
    for (const Appraised& one : maps) {
        const Correspondences points =
            correspondences(one.map.maps, sketches.A().surface, sketches.B().surface);
        starts.push_back([at = at_vertices(points, surfaces.A().surface, surfaces.B().surface)](
                             const LevelPair& level) { return matching_of(at, level); });
    }
    const std::vector<Cues> cues = cues_when_solved(surfaces, Appraisal(surfaces), starts, options);
    for (std::size_t k = 0; k < maps.size(); ++k) {
        Candidate& candidate = maps[k].candidate;
        const double on_sketches = candidate.score;
        set_cues(candidate, cues[k]);
        log("{}: score {:.2f} on the surfaces, {:.2f} on sketches", origin(candidate), candidate.score,
            on_sketches);
        candidate.score = (candidate.score + on_sketches) / 2;
    }
}

}  // namespace

std::vector<Appraised> compared_on_surfaces(std::vector<Appraised> list, const PairContext& sketches,
                                            const FinishingOptions& options,
                                            const std::function<PairContext()>& ask_surfaces) {
    // Above .9, from which on choices are called sure: of a dog onto a lion a limb was wrong, by .92.
    constexpr double decided = 0.95;
    // By more than scores err; chosen by hand.
    constexpr double better = 0.5;
    if (confidence_of(ratings(list)).probability >= decided) return list;
    std::vector<Appraised> rivals = finalists(list);
    if (rivals.size() < 2) return list;
    const PairContext surfaces = ask_surfaces();
    if (!are_quick(surfaces)) return list;
    rate_on(surfaces, rivals, sketches, options);
    const double first = ranking_score(rivals.front().candidate);
    const bool another_is_better = std::any_of(rivals.begin(), rivals.end(), [&](const Appraised& one) {
        return ranking_score(one.candidate) + better < first;
    });
    if (!another_is_better) return list;
    return ordered(std::move(rivals), sketches);
}

}  // namespace varimap
