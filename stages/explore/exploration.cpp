#include "stages/explore/exploration.h"

#include <algorithm>

#include "stages/explore/difference.h"
#include "stages/explore/starts.h"
#include "stages/explore/tips.h"
#include "varimap/core/log.h"
#include "varimap/core/parallel.h"
#include "varimap/core/rotation.h"
#include "varimap/core/statistics.h"
#include "varimap/multilevel/vertex_images.h"

namespace varimap {

namespace {

// Numbers in this file were chosen by hand on the known pairs, not swept.

constexpr int start_levels = 3;
constexpr int most_tips = 8;
/// On coarser levels several tips share a sample.
constexpr int tip_samples = 30;
constexpr int extremities = 8;
/// Maps that go on from every level, if there are so many, besides the others: turned about (difference.h)
/// against the best, which else may have no rival but other ends of the same limbs.
constexpr int least_turned = 2;

/// Least samples of levels on which images of extremities are exchanged, and for how many of the best maps.
/// From 45 samples on instead of 30 they took up to half of the time of exploring: of 30 pairs of animals and
/// people 28 had the same map by either, one a better and one a worse one by 30.
struct SwapRule {
    int samples, best;
};
constexpr SwapRule swap_rules[] = {{18, 4}, {30, 3}};

/// Distinct maps that go on from a level with that many samples. Wrong ones stand out from about 250 samples
/// on.
int promoted(int samples, const ExplorationOptions& options) {
    const int last = options.candidates;
    if (samples < 18) return 1000;
    if (samples < 100) return std::max(last, options.coarse);
    if (samples < 250) return std::max(last, 5);
    if (samples < 500) return std::max(last, 4);
    return last;
}

double mean_square(const RowMatrix& rows, const Eigen::VectorXd& mass) {
    return mass.dot(Eigen::VectorXd(rows.rowwise().squaredNorm()));
}

/// Mean squared distance of two maps' centres, relative to the variance of the embeddings they lie in.
double relative_distance(const Trial& a, const Trial& b, const LevelPair& pair) {
    const Centres &p = a.solution.step.centres, &q = b.solution.step.centres;
    const Side &A = pair.A.side, &B = pair.B.side;
    return mean_square(p.row - q.row, A.mass) / variance(B.points, B.mass) / 2 +
           mean_square(p.column - q.column, B.mass) / variance(A.points, A.mass) / 2;
}

}  // namespace

AlternationOptions for_comparison(AlternationOptions options, double area_bound) {
    options.area_bound = area_bound;
    options.area_energy = AreaEnergy::transported;
    options.tolerance = std::max(options.tolerance, 3e-3);
    options.sinkhorn_iterations = std::min(options.sinkhorn_iterations, 50);
    return options;
}

bool Trial::is_mirrored() const {
    // A right map reads up to a tenth reversed on coarse levels, a mirrored one nearly all.
    return orientation.reversed_mass() > 0.4;
}

Exploration::Exploration(const PairContext& context, const ExplorationOptions& options,
                         const AlternationOptions& alternation, const IroningOptions& ironing)
    : context_(context),
      options_(options),
      alternation_(for_comparison(alternation, options.area_bound)),
      descent_(context, alternation_, ironing) {
    progress_.random.seed(unsigned(options.seed));
}

Trial Exploration::tried(const Start& start, Folds folds) const {
    const Ironing& ironing = descent_.ironing();
    AlternatingMinimization minimization = descent_.settled(start);
    if (descent_.samples() < ironing.options().minimum_samples) return {minimization.take_solution(), {}};
    std::optional<PairOrientation> orientation;
    if (folds == Folds::ironed) orientation = ironing.iron(descent_.level(), minimization, unobserved);
    if (!orientation) orientation = ironing.measure(descent_.level(), minimization.solution());
    return {minimization.take_solution(), std::move(*orientation)};
}

void Exploration::try_all(const std::vector<Start>& starts, Folds folds) {
    std::vector<Trial>& pool = progress_.pool;
    const size_t before = pool.size();
    pool.resize(before + starts.size());
    parallel_for_each_index(starts.size(), size_t(1),
                            [&](size_t n) { pool[before + n] = tried(starts[n], folds); });
}

void Exploration::enter(int level) {
    descent_.enter(context_.diffusion_level(level));
    std::vector<Start> starts;
    for (const Trial& trial : std::exchange(progress_.pool, {}))
        starts.push_back(descent_.hand_down(trial.solution.plan));
    try_all(starts);
}

void Exploration::add_starts() {
    const LevelPair& level = descent_.level();
    const int rows = int(level.A.level.samples.size()), columns = int(level.B.level.samples.size());
    std::vector<Start> starts{zero_start(level)};
    for (const Matching& m : spectral_matchings(context_, level))
        starts.push_back({centres_of(level, m), {}});
    for (const Matching& m : random_matchings(rows, columns, options_.random_starts, progress_.random))
        starts.push_back({centres_of(level, m), {}});
    try_all(starts);
}

void Exploration::add_tip_starts() {
    const LevelPair& level = descent_.level();
    const Tips A = find_tips(context_.graph_A(), level.A.level.samples, most_tips),
               B = find_tips(context_.graph_B(), level.B.level.samples, most_tips);
    std::vector<Start> starts;
    for (const TipMatching& tips : match_tips(A, B, options_.tip_starts))
        starts.push_back({centres_of(level, matching_by_tips(A, B, tips, level)), {}});
    log("{} starts from {} and {} ends of limbs", starts.size(), A.vertices.size(), B.vertices.size());
    try_all(starts);
}

/// Apart from the others, whose energies are less on coarse levels.
void Exploration::add_axes_starts() {
    const LevelPair& level = descent_.level();
    std::vector<Start> starts;
    for (const Matching& m : axes_matchings(context_, level)) starts.push_back({centres_of(level, m), {}});
    std::vector<Trial> others = std::exchange(progress_.pool, {});
    try_all(starts, Folds::left);  // finishing irons them
    prune(options_.axes_maps);
    std::vector<Trial>& pool = progress_.pool;
    std::erase_if(pool, [](const Trial& trial) { return trial.is_mirrored(); });
    log("{} of {} maps from principal axes", pool.size(), starts.size());
    std::move(pool.begin(), pool.end(), std::back_inserter(others));
    pool = std::move(others);
}

void Exploration::add_swaps(int best) {
    const LevelPair& level = descent_.level();
    const Levels& coarse_level = progress_.extremities;
    const LevelSwitch back(coarse_level.A, coarse_level.B, level);
    std::vector<Start> starts;
    for (size_t n = 0; n < std::min(size_t(best), progress_.pool.size()); ++n) {
        const Coupling coarse = coarsened(progress_.pool[n].solution.plan, level, coarse_level);
        for (const Coupling& swapped : with_swapped_rows(coarse, extremities))
            starts.push_back({back.hand_down(swapped, alternation_.support_threshold).centres, {}});
    }
    try_all(starts, Folds::left);  // most are no good: those that are get ironed on the next level
}

void Exploration::prune(int keep) {
    std::vector<Trial>& pool = progress_.pool;
    std::stable_sort(pool.begin(), pool.end(), [](const Trial& a, const Trial& b) {
        return std::pair(a.is_mirrored(), a.energy()) < std::pair(b.is_mirrored(), b.energy());
    });
    const Points best = pool.empty() ? Points() : places(pool.front());
    std::vector<Trial> kept;
    int turned = 0;
    for (Trial& trial : pool) {
        const bool is_full = int(kept.size()) >= keep;
        if (is_full && (turned >= least_turned || trial.is_mirrored())) break;
        const bool is_turned = turned < least_turned && turn(best, places(trial)) > turned_about;
        if (is_full && !is_turned) continue;
        if (std::any_of(kept.begin(), kept.end(), [&](const Trial& better) {
                return relative_distance(better, trial, descent_.level()) < options_.distinct;
            }))
            continue;
        turned += is_turned;
        kept.push_back(std::move(trial));
    }
    pool = std::move(kept);
}

Points Exploration::places(const Trial& trial) const {
    std::vector<int> vertices = largest_of_rows(trial.solution.plan);
    for (int& image : vertices) image = descent_.level().B.level.samples[std::size_t(image)];
    return context_.B().surface.mesh.vertices(vertices, Eigen::all);
}

double Exploration::turn(const Points& best, const Points& other) const {
    return degrees(nearest_rotation(best, other, descent_.level().A.side.mass));
}

VertexImages Exploration::images(const Trial& trial) const {
    return vertex_images(trial.solution, descent_.level(), context_);
}

void Exploration::log_pool() const {
    const LevelPair& pair = descent_.level();
    const std::vector<Trial>& pool = progress_.pool;
    log("level {} ({} x {}): {} maps, energies {:.6g} to {:.6g}", progress_.levels,
        pair.A.level.samples.size(), pair.B.level.samples.size(), pool.size(), pool.front().energy(),
        pool.back().energy());
}

bool Exploration::is_last(int level) const {
    return level + 1 == context_.diffusion_levels() ||
           context_.diffusion_sample_count(level) >= options_.last_samples;
}

Trial Exploration::follow_landmarks() {
    progress_.pool.clear();
    for (int l = 0; l < context_.diffusion_levels(); ++l) {
        enter(l);
        if (l == 0) try_all({zero_start(descent_.level())});
        if (descent_.samples() >= options_.last_samples) break;
    }
    return std::move(progress_.pool.front());
}

void Exploration::explore_next_level() {
    ExplorationProgress& p = progress_;
    const int before = p.levels > 0 ? context_.diffusion_sample_count(p.levels - 1) : 0;
    enter(p.levels);
    const int samples = descent_.samples();
    if (p.levels_with_starts < start_levels && samples >= 5 * p.levels_with_starts) {
        add_starts();
        ++p.levels_with_starts;
    }
    if (before < tip_samples && samples >= tip_samples) add_tip_starts();
    if (samples < swap_rules[0].samples) p.extremities = {descent_.level().A.level, descent_.level().B.level};
    const int keep = promoted(samples, options_);
    prune(keep);
    if (const SwapRule* rule = swap_rules + p.levels_with_swaps;
        rule != std::end(swap_rules) && samples >= rule->samples && !p.extremities.A.samples.empty()) {
        add_swaps(rule->best);
        ++p.levels_with_swaps;
        prune(keep);
    }
    log_pool();
    ++p.levels;
}

ExplorationProgress Exploration::coarse_levels() {
    const int sighted = descent_.ironing().options().minimum_samples;
    while (!is_last(progress_.levels) && context_.diffusion_sample_count(progress_.levels) < sighted)
        explore_next_level();
    return progress_;
}

void Exploration::resume_below(int levels) {
    if (levels == 0) return;
    const Levels last = context_.diffusion_cells(levels - 1);
    descent_.resume(last.A.samples, last.B.samples, "varimap-explore");
}

std::vector<Trial> Exploration::from_axes() {
    progress_.pool.clear();
    int level = 0;
    while (!is_last(level)) ++level;
    resume_below(level);
    enter(level);
    add_axes_starts();
    return progress_.pool;
}

std::vector<Trial> Exploration::go_on(ExplorationProgress progress) {
    progress_ = std::move(progress);
    resume_below(progress_.levels);
    explore_next_level();
    while (!is_last(progress_.levels - 1)) explore_next_level();
    if (options_.axes_maps > 0) add_axes_starts();
    return progress_.pool;
}

}  // namespace varimap
