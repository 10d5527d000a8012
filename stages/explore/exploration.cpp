#include "stages/explore/exploration.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "stages/explore/bending_agreement.h"
#include "stages/explore/starts.h"
#include "varimap/core/log.h"
#include "varimap/core/parallel.h"
#include "varimap/multilevel/solve_level.h"
#include "varimap/multilevel/vertex_images.h"
#include "varimap/spectral/local_shape.h"

namespace varimap {

namespace {

constexpr int start_levels = 3;
constexpr int extremities = 8;

/// Least samples of levels on which images of extremities are exchanged, and for how many of the best maps.
struct SwapRule {
    int samples, best;
};
constexpr SwapRule swap_rules[] = {{18, 4}, {45, 3}, {100, 2}};

/// Distinct maps that go on from a level with that many samples. Wrong ones stand out from about 250 samples
/// on.
int promoted(int samples, int last) {
    if (samples < 18) return 1000;
    if (samples < 100) return std::max(last, 10);
    if (samples < 250) return std::max(last, 5);
    if (samples < 500) return std::max(last, 4);
    return last;
}

/// Exact marginals, because relaxed energies of different maps do not compare; but solved no more precisely
/// than telling maps apart takes.
AlternationOptions for_comparison(AlternationOptions options) {
    options.area_bound = 1;
    options.area_energy = "transported";
    options.tolerance = std::max(options.tolerance, 3e-3);
    options.sinkhorn_iterations = std::min(options.sinkhorn_iterations, 50);
    return options;
}

double variance(const Side& side) {
    const Eigen::RowVectorXd mean = side.mass.transpose() * side.points;
    return side.mass.dot(Eigen::VectorXd((side.points.rowwise() - mean).rowwise().squaredNorm()));
}

double mean_square(const RowMatrix& rows, const Eigen::VectorXd& mass) {
    return mass.dot(Eigen::VectorXd(rows.rowwise().squaredNorm()));
}

/// Mean squared distance of two maps' centres, relative to the variance of the embeddings they lie in.
double relative_distance(const Trial& a, const Trial& b, const LevelPair& pair) {
    const Centres &p = a.solution.step.centres, &q = b.solution.step.centres;
    return mean_square(p.row - q.row, pair.A.side.mass) / variance(pair.B.side) / 2 +
           mean_square(p.column - q.column, pair.B.side.mass) / variance(pair.A.side) / 2;
}

bool is_mirrored(const Trial& trial) {
    return is_mirrored(Candidate{.reversed_mass = trial.orientation.reversed_mass()});
}

void ignore(const Alternation&) {}

}  // namespace

Exploration::Exploration(const PairContext& context, const ExplorationOptions& options,
                         const AlternationOptions& alternation, const IroningOptions& ironing)
    : context_(context),
      options_(options),
      alternation_(for_comparison(alternation)),
      ironing_(ironing),
      random_(unsigned(options.seed)) {}

int Exploration::samples() const {
    return int(std::min(level_.A.level.samples.size(), level_.B.level.samples.size()));
}

Solution Exploration::solve(const Start& start) const {
    AlternatingMinimization minimization(level_.A.side, level_.B.side, alternation_);
    minimization.start(start.centres, start.kept);
    minimization.run(ignore);
    return minimization.take_solution();
}

Trial Exploration::tried(const Start& start, bool ironed) const {
    if (samples() < ironing_.minimum_samples) return {solve(start), 0, 0, {}};
    LevelPair own = level_;  // ironing may change its weights
    Ironing ironing(context_, own, ironing_);
    AlternatingMinimization minimization(own.A.side, own.B.side, alternation_);
    minimization.adopt(solve(start));
    if (ironed) ironing.iron(minimization, ignore);
    const PairOrientation orientation = ironing.measure(minimization.solution());
    return {minimization.take_solution(), 0, 0, orientation};
}

void Exploration::try_all(const std::vector<Start>& starts, bool ironed) {
    const size_t before = pool_.size();
    pool_.resize(before + starts.size());
    parallel_for_each_index(starts.size(), size_t(1),
                            [&](size_t n) { pool_[before + n] = tried(starts[n], ironed); });
}

void Exploration::enter(int level) {
    const LevelPair coarse = std::exchange(level_, context_.diffusion_level(level));
    const std::vector<Trial> promoted = std::exchange(pool_, {});
    if (promoted.empty()) return;
    const LevelSwitch step(coarse.A.level, coarse.B.level, level_);
    std::vector<Start> starts;
    for (const Trial& trial : promoted)
        starts.push_back(step.hand_down(trial.solution.plan, alternation_.support_threshold));
    try_all(starts);
}

void Exploration::add_starts() {
    const int rows = int(level_.A.level.samples.size()), columns = int(level_.B.level.samples.size());
    std::vector<Start> starts{zero_start(level_)};
    for (const Matching& m : spectral_matchings(context_, level_))
        starts.push_back({centres_of(level_, m), {}});
    for (const Matching& m : random_matchings(rows, columns, options_.random_starts, random_))
        starts.push_back({centres_of(level_, m), {}});
    try_all(starts);
}

void Exploration::add_swaps(int best) {
    const LevelSwitch back(extremities_.A.level, extremities_.B.level, level_);
    std::vector<Start> starts;
    for (size_t n = 0; n < std::min(size_t(best), pool_.size()); ++n) {
        const Coupling coarse = coarsened(pool_[n].solution.plan, level_, extremities_);
        for (const Coupling& swapped : with_swapped_rows(coarse, extremities))
            starts.push_back({back.hand_down(swapped, alternation_.support_threshold).centres, {}});
    }
    try_all(starts, false);  // most are no good: those that are get ironed on the next level
}

void Exploration::prune(int keep) {
    std::stable_sort(pool_.begin(), pool_.end(), [](const Trial& a, const Trial& b) {
        return std::pair(is_mirrored(a), a.energy()) < std::pair(is_mirrored(b), b.energy());
    });
    std::vector<Trial> kept;
    for (Trial& trial : pool_) {
        if (int(kept.size()) == keep) break;
        if (std::none_of(kept.begin(), kept.end(), [&](const Trial& better) {
                return relative_distance(better, trial, level_) < options_.distinct;
            }))
            kept.push_back(std::move(trial));
    }
    pool_ = std::move(kept);
}

double Exploration::score(const Trial& trial) const {
    return std::log(trial.energy()) + options_.euclidean_exponent * std::log(trial.euclidean_energy) -
           options_.bending_weight * trial.bending_agreement;
}

void Exploration::measure_finalists() {
    constexpr double time = 4e-3;  // units of area: smooths over about a tenth of sqrt(area)
    const Eigen::VectorXd bending_A = bending(context_.A(), time), bending_B = bending(context_.B(), time);
    for (Trial& trial : pool_)
        trial.bending_agreement = bending_agreement(level_, bending_A, bending_B, trial.orientation.A_to_B,
                                                    trial.orientation.B_to_A);
    const LevelPair euclidean = context_.euclidean_level(0, 1);
    const LevelSwitch step(level_.A.level, level_.B.level, euclidean);
    parallel_for_each_index(pool_.size(), size_t(1), [&](size_t n) {
        const Start start = step.hand_down(pool_[n].solution.plan, alternation_.support_threshold);
        AlternatingMinimization minimization(euclidean.A.side, euclidean.B.side, alternation_);
        minimization.start(start.centres, start.kept);
        minimization.run(ignore);
        pool_[n].euclidean_energy = minimization.solution().step.energy;
    });
}

std::vector<Trial> Exploration::run() {
    const SwapRule* swap = std::begin(swap_rules);
    int started = 0;
    for (int l = 0; l < context_.diffusion_levels(); ++l) {
        enter(l);
        if (started < start_levels && samples() >= 5 * started) add_starts(), ++started;
        if (samples() < swap_rules[0].samples) extremities_ = level_;
        prune(promoted(samples(), options_.candidates));
        if (swap != std::end(swap_rules) && samples() >= swap->samples &&
            !extremities_.A.level.samples.empty()) {
            add_swaps(swap->best);
            prune(promoted(samples(), options_.candidates));
            ++swap;
        }
        log("level {} ({} x {}): {} maps, energies {:.6g} to {:.6g}", l, level_.A.level.samples.size(),
            level_.B.level.samples.size(), pool_.size(), pool_.front().energy(), pool_.back().energy());
    }
    measure_finalists();
    std::stable_sort(pool_.begin(), pool_.end(), [&](const Trial& a, const Trial& b) {
        return std::pair(is_mirrored(a), score(a)) < std::pair(is_mirrored(b), score(b));
    });
    return pool_;
}

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
    constexpr double elsewhere = 0.1;  // units of sqrt(area)
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

}  // namespace

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

namespace {

/// Per INPUT vertex of B, its image on INPUT faces of A, as well as the last diffusion level tells.
PointMap preview(const Trial& trial, const LevelPair& pair, const PairContext& context) {
    const SparseMatrix plan = to_matrix(trial.solution.plan, pair.A.side.mass, pair.B.side.mass);
    const std::vector<int> image =
        vertex_images(pair.B, pair.A, trial.solution.step.column_image, plan.transpose(), context.graph_A());
    const Surface &A = context.A().surface, &B = context.B().surface;
    PointMap map(B.vertex_of_input.size());
    for (size_t v = 0; v < map.size(); ++v)
        if (B.vertex_of_input[v] >= 0) map[v] = A.on_input[image[B.vertex_of_input[v]]];
    return between_input_and_file(std::move(map), A);
}

}  // namespace

Candidates explore(const PairContext& context, const ExplorationOptions& options,
                   const AlternationOptions& alternation, const IroningOptions& ironing) {
    Exploration exploration(context, options, alternation, ironing);
    const std::vector<Trial> trials = exploration.run();
    constexpr size_t coarse_samples = 20;
    int level = 0;
    LevelPair coarse = context.diffusion_level(0);
    while (coarse.A.level.samples.size() < coarse_samples && level + 1 < context.diffusion_levels())
        coarse = context.diffusion_level(++level);
    Candidates found{coarse.A.level.samples,
                     coarse.B.level.samples,
                     coarse.A.side.mass,
                     coarse.B.side.mass,
                     describe(exploration, trials, context),
                     {},
                     {}};
    for (const Trial& trial : trials)
        found.plans.push_back(to_matrix(coarsened(trial.solution.plan, exploration.last_level(), coarse),
                                        found.mass_A, found.mass_B));
    constexpr size_t shown = 3;
    if (!confidence_of(found.list).confident)
        for (size_t k = 0; k < std::min(trials.size(), shown); ++k)
            found.previews.push_back(preview(trials[k], exploration.last_level(), context));
    return found;
}

}  // namespace varimap
