#include "stages/diffuse/check_landmarks.h"

#include <algorithm>

#include "varimap/core/error.h"
#include "varimap/core/log.h"
#include "varimap/core/parallel.h"
#include "varimap/multilevel/descent.h"
#include "varimap/multilevel/exchanged_landmarks.h"
#include "varimap/pair_stage/landmark_vertices.h"

namespace varimap {

namespace {

/// From here on maps that differ have different energies; finer levels only cost more. Chosen by hand on the
/// known pairs, not swept.
constexpr std::size_t enough_samples = 100;

/// Each landmark costs a coarse map: 642 took 97 s of CPU time. So many decide a map that one hardly counts.
constexpr std::size_t most_landmarks = 100;

using Landmark = VertexPairs<MeshVertex>::value_type;

/// The landmarks of a level, pinned.
Partners pinned(Partners partners) {
    partners.weight = 1;
    return partners;
}

Partners without(const Landmark& landmark, const LevelPair& level, Partners partners) {
    partners.row[std::size_t(level.A.level.cell[std::size_t(landmark.first.index)])] = -1;
    partners.column[std::size_t(level.B.level.cell[std::size_t(landmark.second.index)])] = -1;
    return partners;
}

/// Coarse maps with the landmarks pinned.
struct PinnedMaps {
    Solution all;                   ///< with all landmarks
    std::vector<Solution> lacking;  ///< per landmark: without it
};

/// Solves all of them at the level the descent has entered.
void solve(const Descent& descent, const VertexPairs<MeshVertex>& landmarks, PinnedMaps& maps) {
    const bool coarsest = maps.lacking.empty();
    maps.lacking.resize(landmarks.size());
    const LevelPair& level = descent.level();
    const Partners partners = pinned(level.partners);
    const auto solve_one = [&](const Partners& own, Solution& solution) {
        const Start start = coarsest ? zero_start(level) : descent.hand_down(solution.plan);
        solution = descent.settled(start, own).take_solution();
    };
    solve_one(partners, maps.all);
    parallel_for_each_index(landmarks.size(), std::size_t(1), [&](std::size_t n) {
        solve_one(without(landmarks[n], level, partners), maps.lacking[n]);
    });
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

/// How far along B the map that lacks a landmark takes its vertex of A from its vertex of B.
double distance_to_partner(const Landmark& landmark, const Solution& lacking, const LevelPair& level,
                           const PairContext& context) {
    const int sample = level.A.level.cell[std::size_t(landmark.first.index)];
    const int there = image(level, lacking, sample, context);
    return geodesic_distance(landmark.second.index, there, context.graph_B());
}

}  // namespace

std::vector<LandmarkCheck> check_landmarks(const PairContext& context, const AlternationOptions& options) {
    const VertexPairs<MeshVertex>& landmarks = context.landmarks();
    if (landmarks.size() < 2) return {};  // nothing to contradict
    if (landmarks.size() > most_landmarks) {
        warn("{} landmarks are not checked against each other: beyond {} it takes too long", landmarks.size(),
             most_landmarks);
        return {};
    }
    Descent descent(context, options, {});
    PinnedMaps maps;
    int next = 0;
    do {
        descent.enter(context.diffusion_level(next++));
        solve(descent, landmarks, maps);
    } while (next < context.diffusion_levels() && descent.level().A.level.samples.size() < enough_samples);
    std::vector<LandmarkCheck> checks;
    for (std::size_t n = 0; n < landmarks.size(); ++n)
        checks.push_back({distance_to_partner(landmarks[n], maps.lacking[n], descent.level(), context),
                          1 - maps.lacking[n].step.energy / maps.all.step.energy});
    return checks;
}

void warn_of_exchanged_columns(const Landmarks& landmarks, const PairContext& context) {
    const Surface &A = context.A().surface, &B = context.B().surface;
    if (!landmarks.points.empty() || !A.link.is_identity() || !B.link.is_identity()) return;
    VertexPairs<InputVertex> other;
    for (const auto& [a, b] : landmarks.vertices) {
        if (b.index >= A.input.vertex_count() || a.index >= B.input.vertex_count()) return;
        other.emplace_back(b, a);
    }
    try {
        if (!distances_fit(context, to_mesh_vertices(other, A, B))) return;
    } catch (const InputError&) {
        return;  // two are one vertex, or belong to no face
    }
    warn(
        "source and target look exchanged in the landmarks: distances between them agree far better with the "
        "source's vertices on the target, and the target's on the source");
}

void report(const std::vector<LandmarkCheck>& checks) {
    constexpr double decides = .1;  // sqrt(area): no detail any more
    const int worst = contradicted_landmark(checks);
    for (size_t i = 0; i < checks.size(); ++i) {
        const LandmarkCheck& check = checks[i];
        log("landmark {}: the others alone would have its place {:.3f} sqrt(area) away, and the energy "
            "{:.1f}% "
            "lower{}",
            i + 1, check.distance, 100 * check.energy_fall,
            int(i) == worst            ? ""
            : check.distance < decides ? "; it agrees with them"
                                       : "; it does not contradict them, and decides what they leave open");
    }
    if (worst >= 0)
        warn("landmark {} is contradicted by the others: is it in the right place, on the right side?",
             worst + 1);
}

}  // namespace varimap
