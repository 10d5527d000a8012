#include "stages/explore/explore.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "varimap/multilevel/sparse_plan.h"
#include "varimap/multilevel/vertex_images.h"

namespace varimap {

namespace {

/// Degrees of the rotation R that minimises sum m |R (x - mean x) - (y - mean y)|^2 (Kabsch).
double best_turn(const Points& x, const Points& y, const Eigen::VectorXd& mass) {
    const Eigen::RowVector3d mean_x = mass.transpose() * x / mass.sum(),
                             mean_y = mass.transpose() * y / mass.sum();
    const Eigen::Matrix3d products =
        (y.rowwise() - mean_y).transpose() * mass.asDiagonal() * (x.rowwise() - mean_x);
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(products, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
    const Eigen::Matrix3d R =
        svd.matrixU() * Eigen::Vector3d(1, 1, sign).asDiagonal() * svd.matrixV().transpose();
    return Eigen::AngleAxisd(R).angle() * 180 / M_PI;
}

/// Compares a map with the best one: where the latter's inverse takes the images of the samples of A.
void compare(const Trial& best, const Trial& other, const LevelPair& pair, const PairContext& context,
             Candidate& candidate) {
    constexpr double elsewhere = 0.1;  // units of sqrt(area); chosen by hand, not swept
    const std::vector<int>& samples = pair.A.level.samples;
    const TriangleMesh& mesh = context.A().surface.mesh;
    const std::vector<int>& image = other.orientation.A_to_B.image_vertex;
    const std::vector<int>& back = best.orientation.B_to_A.image_vertex;
    if (image.empty() || back.empty()) return;
    Points x(samples.size(), 3), y(samples.size(), 3);
    for (size_t k = 0; k < samples.size(); ++k) {
        x.row(k) = mesh.vertices.row(samples[k]);
        y.row(k) = mesh.vertices.row(back[pair.B.level.cell[image[k]]]);
        if ((x.row(k) - y.row(k)).norm() > elsewhere) candidate.moved_mass += pair.A.side.mass[k];
    }
    candidate.turn = best_turn(x, y, pair.A.side.mass);
}

/// What there is to say about the maps an exploration found, for each.
std::vector<Candidate> describe(const Exploration& exploration, const std::vector<Trial>& trials,
                                const PairContext& context) {
    std::vector<Candidate> list;
    for (const Trial& trial : trials) {
        Candidate candidate{.diffusion_energy = trial.energy(),
                            .euclidean_energy = trial.euclidean_energy,
                            .bending_agreement = trial.bending_agreement,
                            .score = exploration.score(trial),
                            .reversed_mass = trial.orientation.reversed_mass()};
        if (&trial != &trials.front())
            compare(trials.front(), trial, exploration.last_level(), context, candidate);
        list.push_back(candidate);
    }
    return list;
}

/// Per INPUT vertex of B, its image on INPUT faces of A, as well as the last diffusion level tells.
PointMap preview(const Trial& trial, const LevelPair& pair, const PairContext& context) {
    const std::vector<int> image = vertex_images(pair.B, pair.A, trial.solution.step.column_image,
                                                 largest_of_columns(trial.solution.plan), context.graph_A());
    const Surface &A = context.A().surface, &B = context.B().surface;
    PointMap map(B.on_mesh.size());
    for (size_t v = 0; v < map.size(); ++v)
        if (const MeshVertex vertex = mesh_vertex_at(B, {int(v)}); vertex.index >= 0)
            map[v] = A.on_input[image[vertex.index]];
    return between_input_and_file(std::move(map), A);
}

/// The first level with enough samples to tell a map, or the last.
Levels coarse_level(const PairContext& context) {
    constexpr size_t enough = 20;  // chosen by hand on the known pairs, not swept
    int l = 0;
    Levels coarse = context.diffusion_samples(l);
    while (coarse.A.samples.size() < enough && l + 1 < context.diffusion_levels())
        coarse = context.diffusion_samples(++l);
    return coarse;
}

}  // namespace

Candidates explore(const PairContext& context, const ExplorationOptions& options,
                   const AlternationOptions& alternation, const IroningOptions& ironing) {
    Exploration exploration(context, options, alternation, ironing);
    const std::vector<Trial> trials = exploration.run();
    const LevelPair& last = exploration.last_level();
    const Levels coarse = coarse_level(context);
    Candidates found{.samples_A = coarse.A.samples,
                     .samples_B = coarse.B.samples,
                     .mass_A = coarse.A.mass,
                     .mass_B = coarse.B.mass,
                     .list = describe(exploration, trials, context),
                     .plans = {},
                     .previews = {}};
    for (const Trial& trial : trials)
        found.plans.push_back(
            to_matrix(coarsened(trial.solution.plan, last, coarse), found.mass_A, found.mass_B));
    constexpr size_t shown = 3;
    if (!confidence_of(found.list).confident)
        for (size_t k = 0; k < std::min(trials.size(), shown); ++k)
            found.previews.push_back(preview(trials[k], last, context));
    return found;
}

}  // namespace varimap
