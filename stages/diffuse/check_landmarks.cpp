#include "stages/diffuse/check_landmarks.h"

#include <algorithm>

#include "varimap/multilevel/orientation.h"
#include "varimap/multilevel/solve_level.h"

namespace varimap {

namespace {

constexpr std::size_t enough_samples = 100;

std::vector<LevelPair> coarse_levels(const PairContext& context) {
    std::vector<LevelPair> levels;
    while (int(levels.size()) < context.diffusion_levels() &&
           (levels.empty() || levels.back().A.level.samples.size() < enough_samples)) {
        LevelPair pair = context.diffusion_level(int(levels.size()));
        pair.A.side.landmark_weight = pair.B.side.landmark_weight = 1;
        levels.push_back(std::move(pair));
    }
    return levels;
}

Solution solve(const std::vector<LevelPair>& levels, const AlternationOptions& options) {
    Solution solution;
    for (std::size_t l = 0; l < levels.size(); ++l) {
        const LevelPair& pair = levels[l];
        const Start start = l == 0 ? zero_start(pair)
                                   : hand_down(solution.plan, levels[l - 1].A.level, levels[l - 1].B.level,
                                               pair, options.support_threshold);
        AlternatingMinimization minimization(pair.A.side, pair.B.side, options);
        minimization.start(start.centres, start.kept);
        minimization.run([](const Alternation&) {});
        solution = minimization.take_solution();
    }
    return solution;
}

/// Pins a landmark on all levels, or lets it go.
void set_pinned(std::vector<LevelPair>& levels, const std::pair<MeshVertex, MeshVertex>& landmark,
                bool pinned) {
    for (LevelPair& pair : levels) {
        const int i = pair.A.level.cell[std::size_t(landmark.first.index)],
                  j = pair.B.level.cell[std::size_t(landmark.second.index)];
        pair.A.side.partner[i] = pinned ? j : -1;
        pair.B.side.partner[j] = pinned ? i : -1;
    }
}

double geodesic_distance(int from, int to, const GeodesicGraph& graph) {
    double distance = 0;
    GeodesicBall(graph).grow(from, [&](int v, double d) {
        distance = d;
        return v != to;
    });
    return distance;
}

/// The vertex of B nearest to where the map takes a sample of A.
int image(const LevelPair& pair, const Solution& solution, int sample, const PairContext& context) {
    const auto centre = solution.step.centres.row.row(sample);
    Eigen::Index nearest;
    (pair.B.side.points.rowwise() - centre).rowwise().squaredNorm().minCoeff(&nearest);
    return nearest_by_descent(pair.B.level.samples[std::size_t(nearest)], centre, pair.B.vertex_points,
                              context.graph_B());
}

}  // namespace

std::vector<LandmarkCheck> check_landmarks(const PairContext& context, const AlternationOptions& options) {
    std::vector<LandmarkCheck> checks;
    if (context.landmarks().size() < 2) return checks;  // nothing to contradict
    std::vector<LevelPair> levels = coarse_levels(context);
    const double energy = solve(levels, options).step.energy;
    for (const auto& landmark : context.landmarks()) {
        set_pinned(levels, landmark, false);
        const Solution without = solve(levels, options);
        const LevelPair& last = levels.back();
        const int there = image(last, without, last.A.level.cell[std::size_t(landmark.first.index)], context);
        checks.push_back({geodesic_distance(landmark.second.index, there, context.graph_B()),
                          1 - without.step.energy / energy});
        set_pinned(levels, landmark, true);
    }
    return checks;
}

}  // namespace varimap
