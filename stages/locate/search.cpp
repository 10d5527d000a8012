#include "stages/locate/search.h"

#include <array>
#include <cmath>
#include <utility>

#include "varimap/core/log.h"
#include "varimap/core/parallel.h"
#include "varimap/multilevel/descent.h"
#include "varimap/multilevel/descriptor_terms.h"
#include "varimap/multilevel/matching.h"
#include "varimap/multilevel/solved_map.h"

namespace varimap {

namespace {

/// Of the descriptors, one for each try: on none of ten parts of people and animals all of them found the
/// right place, and one of them always did.
constexpr std::array<DescriptorWeights, 6> tries{{{.25, 4}, {1, 0}, {1, 4}, {.25, 0}, {0, 0}, {0, 4}}};
/// Always as many, so that results do not depend on the threads.
constexpr std::size_t tries_at_a_time = 2;

/// The samples of each side with those of the other that are alike far from the landmarks.
class MatchingByDistances {
  public:
    /// `ratio`: lengths of B's mesh over those of A's.
    MatchingByDistances(const PairContext& context, double ratio)
        : A_(ratio * distances_from_each(context.graph_A(), context.landmarks_A()).transpose()),
          B_(distances_from_each(context.graph_B(), context.landmarks_B()).transpose()) {}

    Matching operator()(const LevelPair& pair) const {
        const RowMatrix a = A_(pair.A.level.samples, Eigen::all), b = B_(pair.B.level.samples, Eigen::all);
        Matching matching;
        for (int i = 0; i < a.rows(); ++i) matching.emplace_back(i, most_alike(a.row(i), b));
        for (int j = 0; j < b.rows(); ++j) matching.emplace_back(most_alike(b.row(j), a), j);
        return matching;
    }

  private:
    /// Differences count relative to the distance.
    static int most_alike(const Eigen::RowVectorXd& x, const RowMatrix& others) {
        constexpr double least = 0.1;
        const Eigen::RowVectorXd weight = (x.array() + least).inverse();
        int best;
        ((others.rowwise() - x).array().rowwise() * weight.array())
            .matrix()
            .rowwise()
            .squaredNorm()
            .minCoeff(&best);
        return best;
    }
    RowMatrix A_, B_;
};

/// The map of a plan that is solved for down the levels that can hold on to a map.
MapPair solve(const PairContext& context, const MatchingByDistances& begin, const DescriptorWeights& weights,
              const LocateParams& params, double share) {
    AlternationOptions alternation = params.alternation;
    alternation.part = params.part;
    alternation.part_share = share;
    Descent descent(context, alternation, params.ironing);
    Solution solution;
    const int first = first_level_for_a_map(context);
    const auto go_on = [&](LevelPair level, bool is_first, bool is_ironed) {
        add_descriptor_terms(level, context, weights);
        descent.enter(std::move(level));
        AlternatingMinimization minimization =
            descent.settled(is_first ? Start{centres_of(descent.level(), begin(descent.level())), {}}
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

PlacedPart try_with(const DescriptorWeights& weights, const MatchingByDistances& begin,
                    const PairContext& sketches, const Sides& sides, double share,
                    const LocateParams& params) {
    MapPair maps = solve(sketches, begin, weights, params, share);
    PointMap& images = params.part == Part::source ? maps.A_to_B : maps.B_to_A;
    return place(std::move(images), sides, share, params.placing);
}

}  // namespace

PlacedPart find_place(const PairContext& sketches, const Sides& sides, double share,
                      const LocateParams& params) {
    const double ratio = std::sqrt(share);  // both meshes have unit area
    const MatchingByDistances by_distances(sketches, params.part == Part::source ? ratio : 1 / ratio);
    PlacedPart best;
    for (std::size_t first = 0; first < tries.size(); first += tries_at_a_time) {
        std::array<PlacedPart, tries_at_a_time> placed;
        parallel_for_each_index(tries_at_a_time, std::size_t(1), [&](std::size_t k) {
            placed[k] = try_with(tries[first + k], by_distances, sketches, sides, share, params);
        });
        for (std::size_t k = 0; k < tries_at_a_time; ++k) {
            const DescriptorWeights& weights = tries[first + k];
            log("shape {}, vicinity {}: strain {:.4f}", weights.shape, weights.vicinity, placed[k].strain);
            if (best.images.empty() || placed[k].strain < best.strain) best = std::move(placed[k]);
        }
        if (best.strain < params.enough) break;
    }
    return best;
}

}  // namespace varimap
