#include "stages/diffuse/diffuse.h"

#include <fmt/format.h>

#include <algorithm>

#include "stages/diffuse/check_landmarks.h"
#include "varimap/core/error.h"
#include "varimap/multilevel/descent.h"
#include "varimap/multilevel/descriptor_terms.h"
#include "varimap/multilevel/matching.h"
#include "varimap/multilevel/sparse_plan.h"
#include "varimap/multilevel/vertex_images.h"
#include "varimap/multilevel/wasserstein_centres.h"

namespace varimap {

namespace {

/// Coarsest level: the full plan, from centres at the origin unless the surfaces are aligned.
Start coarsest_start(const LevelPair& pair, const PairContext& context, const DiffuseParams& params) {
    if (params.start == FirstCentres::zero) return zero_start(pair);
    return {wasserstein_centres(pair, context, params.alternation), {}};
}

LevelPair level_with_terms(int index, const PairContext& context, const DiffuseParams& params) {
    LevelPair pair = context.diffusion_level(index);
    if (params.wasserstein_weight > 0) add_wasserstein_term(pair, context, params.wasserstein_weight);
    add_descriptor_terms(pair, context, params.descriptors);
    return pair;
}

const Correspondences& chosen_map(const Candidates& candidates, int number) {
    if (number > int(candidates.maps.size()))
        throw UsageError(
            fmt::format("candidate {}: varimap-explore found {}", number, candidates.maps.size()));
    return candidates.maps[size_t(number - 1)];
}

Diffusion to_diffusion(const LevelPair& pair, const Solution& solution, const PairContext& context) {
    Diffusion diffusion;
    VertexImages images = vertex_images(solution, pair, context);
    diffusion.image_vertex_A = std::move(images.A_to_B);
    diffusion.image_vertex_B = std::move(images.B_to_A);
    diffusion.record.landmarks = context.landmarks();
    diffusion.record.landmark_weight = context.landmark_weight();
    return diffusion;
}

}  // namespace

Diffusion diffuse(const PairContext& context, const DiffuseParams& params,
                  const std::optional<Candidates>& found, const std::optional<Correspondences>& initial_map) {
    const bool decided = found && landmarks_decide(*found);
    const Candidates* candidates = found && !found->list.empty() ? &*found : nullptr;
    if (decided && params.candidate > 1)
        throw UsageError(
            fmt::format("candidate {}: there is no other map than where the landmarks lead; if none was "
                        "looked for, varimap map --explore does, and fewer landmarks leave more to find",
                        params.candidate));
    const int all = context.diffusion_levels();
    const int levels = params.levels > 0 ? std::min(params.levels, all) : all;
    TracedDescent descent(context, params.alternation, params.ironing);
    std::optional<VertexCorrespondences> begun;
    if (const Correspondences* map = candidates    ? &chosen_map(*candidates, params.candidate)
                                     : initial_map ? &*initial_map
                                                   : nullptr)
        begun = at_vertices(*map, context.A().surface, context.B().surface);
    // Candidates are finished maps of sketches: what coarser levels could find is in them.
    const int first = candidates ? levels - 1
                      : begun    ? std::min(first_level_for_a_map(context), levels - 1)
                                 : 0;
    Solution solution;
    for (int l = first; l < levels; ++l) {
        descent.enter(level_with_terms(l, context, params));
        const LevelPair& level = descent.level();
        const Start start = l > first ? descent.hand_down(solution.plan)
                            : begun   ? Start{centres_of(level, matching_of(*begun, level)), {}}
                                      : coarsest_start(level, context, params);
        solution = descent.solve(start, {.index = l, .last = l + 1 == levels});
    }
    Diffusion diffusion = to_diffusion(descent.level(), solution, context);
    diffusion.plan = to_sample_plan(descent.level(), solution.plan, params.alternation.area_bound);
    diffusion.trace = descent.take_trace();
    if (params.check_landmarks)
        diffusion.record.landmark_checks = check_landmarks(context, params.alternation);
    if (candidates && !decided) {
        diffusion.record.candidates = candidates->list;
        diffusion.record.candidate = params.candidate;
    }
    return diffusion;
}

}  // namespace varimap
