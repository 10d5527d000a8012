#include "stages/locate/search.h"

#include <array>
#include <utility>

#include "stages/locate/starts.h"
#include "varimap/core/log.h"
#include "varimap/core/parallel.h"
#include "varimap/multilevel/descent.h"
#include "varimap/multilevel/descriptor_terms.h"
#include "varimap/multilevel/solved_map.h"

namespace varimap {

namespace {

/// Of the descriptors, one for each plan: no weights found the right place of all parts that were tried.
constexpr std::array<DescriptorWeights, 6> weights_of_plans{
    {{.25, 4}, {1, 0}, {1, 4}, {.25, 0}, {0, 0}, {0, 4}}};
/// Always as many, so that results do not depend on the threads.
constexpr std::size_t tries_at_a_time = 2;

/// The map of a plan that is solved for down the levels that can hold on to a map.
MapPair solve(const PairContext& context, const LandmarkDistances& distances,
              const DescriptorWeights& weights, const LocateParams& params, double share) {
    AlternationOptions alternation = params.alternation;
    alternation.part_share = share;
    Descent descent(context, alternation, params.ironing);
    Solution solution;
    const int first = first_level_for_a_map(context);
    const auto go_on = [&](LevelPair level, bool is_first, bool is_ironed) {
        add_descriptor_terms(level, context, weights);
        descent.enter(std::move(level));
        AlternatingMinimization minimization = descent.settled(
            is_first ? Start{centres_of(descent.level(),
                                        distances.matching(descent.level(), params.alternation.part)),
                             {}}
                     : descent.hand_down(solution.plan));
        if (is_ironed) descent.ironing().iron(descent.level(), minimization, unobserved, params.ironing);
        solution = minimization.take_solution();
    };
    for (int l = first; l < context.diffusion_levels(); ++l)
        go_on(context.diffusion_level(l), l == first, true);
    const int last = context.euclidean_levels() - 1;
    for (int l = 0; l <= last; ++l) go_on(context.euclidean_level(l, l < last ? 1 : 0), false, l < last);
    return solved_map(solution, descent.level(), context, 1);
}

/// The images that the n-th try places the part from.
PointMap images_of_try(std::size_t n, const LandmarkDistances& distances, const PairContext& sketches,
                       const Sides& sides, double share, const LocateParams& params) {
    if (n == 0) return rigid_images(sides, share);
    if (n == 1) return distances.images(sides.whole.mesh);
    MapPair maps = solve(sketches, distances, weights_of_plans[n - 2], params, share);
    return std::move(params.alternation.part == PartSide::source ? maps.A_to_B : maps.B_to_A);
}

/// Times the option's relief weight: with much of it the part follows its like where it can, with little it
/// comes there from afar.
constexpr std::array<double, 2> relief_factors{0.5, 1.5};

Placement best_placement(const PointMap& images, const Sides& sides, double share, PlacingOptions options) {
    const double weight = options.relief_weight;
    Placement best;
    for (const double factor : relief_factors) {
        options.relief_weight = factor * weight;
        Placement other = pinned_placement(images, sides, share, options);
        if (best.images.empty() || other.strain < best.strain) best = std::move(other);
    }
    return best;
}

}  // namespace

Placement find_placement(const PairContext& sketches, const Sides& sides, double share,
                         const LocateParams& params) {
    const LandmarkDistances distances(sides, share);
    Placement best;
    for (std::size_t first = 0; first < weights_of_plans.size() + 2; first += tries_at_a_time) {
        std::array<Placement, tries_at_a_time> placed;
        parallel_for_each_index(tries_at_a_time, std::size_t(1), [&](std::size_t k) {
            placed[k] = best_placement(images_of_try(first + k, distances, sketches, sides, share, params),
                                       sides, share, params.placing);
        });
        for (std::size_t k = 0; k < tries_at_a_time; ++k) {
            log("try {}: strain {:.4f}", first + k + 1, placed[k].strain);
            if (best.images.empty() || placed[k].strain < best.strain) best = std::move(placed[k]);
        }
        if (best.strain < params.enough) break;
    }
    return best;
}

}  // namespace varimap
