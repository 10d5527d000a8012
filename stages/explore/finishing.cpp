#include "stages/explore/finishing.h"

#include <algorithm>
#include <limits>

#include "stages/explore/difference.h"
#include "stages/explore/loose_components.h"
#include "varimap/core/counted.h"
#include "varimap/core/error.h"
#include "varimap/core/log.h"
#include "varimap/core/parallel.h"
#include "varimap/core/timing.h"
#include "varimap/mesh/interpolation.h"
#include "varimap/multilevel/descent.h"
#include "varimap/multilevel/descriptor_terms.h"
#include "varimap/multilevel/sparse_plan.h"
#include "varimap/multilevel/vertex_images.h"
#include "varimap/results/candidate.h"
#include "varimap/results/read_out.h"
#include "varimap/untangling/untangling.h"

namespace varimap {

namespace {

/// A start on its way down.
struct Pursued {
    int start;
    Solution solution;
    VertexImages images;               ///< when it was last judged
    Cues cues;                         ///< the same
    std::vector<double> rough_scores;  ///< of all levels so far
    double score() const { return rough_scores.back(); }
    double energy() const { return solution.step.energy; }
};

/// On the Euclidean levels little may be paid for less that is reversed.
IroningOptions euclidean_ironing(IroningOptions options, int rounds) {
    constexpr double log_energy_for_mass = 0.5;
    options.maximum_rounds = rounds;
    options.energy_for_mass = log_energy_for_mass;
    return options;
}

MapPair to_maps(const VertexImages& images, const PairContext& context) {
    return {images_at(images.A_to_B, context.B().surface.mesh),
            images_at(images.B_to_A, context.A().surface.mesh)};
}

/// The way down of all starts, level by level.
class JointDescent {
  public:
    JointDescent(const PairContext& context, const Appraisal& appraisal, const FinishingOptions& options,
                 const std::vector<FinishedMap>& known)
        : context_(context),
          appraisal_(appraisal),
          options_(options),
          known_(known),
          loose_(context, appraisal),
          descent_(context, options.alternation, options.ironing),
          euclidean_ironing_(euclidean_ironing(options.ironing, options.euclidean_rounds)) {}

    std::vector<Pursued> run(const std::vector<MapStart>& starts) {
        const int first = begin(starts);
        keep_best(options_.gap_at_first);
        // A map that is by itself, as that which landmarks lead to, has no other to be chosen instead.
        // Without this level the hands of one of 14 isometric pairs ended twisted.
        if (const int last = context_.diffusion_levels() - 1; starts.size() == 1 && last > first)
            go_on(context_.diffusion_level(last), options_.ironing);
        for (int l = first_euclidean_level(); l < context_.euclidean_levels(); ++l) {
            go_on_in_space(l);
            keep_best(options_.gap);
            if (int(pursued_.size()) > options_.most) pursued_.resize(std::size_t(options_.most));
        }
        return std::move(pursued_);
    }
    /// All of them, none dropped, until the first is clearly the best.
    std::vector<Pursued> run_until_first_is_best(const std::vector<MapStart>& starts) {
        begin(starts);
        for (int l = first_euclidean_level(); l < context_.euclidean_levels(); ++l) {
            go_on_in_space(l);
            judge_all();
            if (first_is_clearly_best()) break;
        }
        return std::move(pursued_);
    }
    const LevelPair& level() const { return descent_.level(); }
    const LooseComponents& loose() const { return loose_; }

  private:
    /// Solves the first level, and returns its index.
    int begin(const std::vector<MapStart>& starts) {
        for (int n = 0; n < int(starts.size()); ++n) pursued_.push_back({n, {}, {}, {}, {}});
        const int first = first_level_for_a_map(context_);
        enter(context_.diffusion_level(first));
        solve_all(options_.ironing, [&](const Pursued& one) {
            return Start{centres_of(level(), starts[std::size_t(one.start)](level())), {}};
        });
        return first;
    }
    /// The last but one, that of every vertex being the last.
    int first_euclidean_level() const { return std::max(0, context_.euclidean_levels() - 2); }
    void go_on_in_space(int index) {
        const bool is_last = index + 1 == context_.euclidean_levels();
        go_on(context_.euclidean_level(index, is_last ? 0 : 1), euclidean_ironing_);
    }
    void enter(LevelPair level) {
        add_descriptor_terms(level, context_, options_.descriptors);
        descent_.enter(std::move(level));
    }
    void go_on(LevelPair level, const IroningOptions& ironing) {
        enter(std::move(level));
        solve_all(ironing, [&](const Pursued& one) { return descent_.hand_down(one.solution.plan); });
    }
    template <class StartOf>
    void solve_all(const IroningOptions& ironing, const StartOf& start_of) {
        parallel_for_each_index(pursued_.size(), std::size_t(1), [&](std::size_t n) {
            AlternatingMinimization minimization = descent_.settled(start_of(pursued_[n]));
            descent_.ironing().iron(descent_.level(), minimization, unobserved, ironing);
            pursued_[n].solution = minimization.take_solution();
        });
    }
    /// The best by their rough scores, the best first. Energies are no numbers, or negative, where
    /// coordinates are too large to be squared.
    void keep_best(double gap) {
        const Timer timer("rough scores");
        std::erase_if(pursued_, [](const Pursued& one) { return !(one.energy() >= 0); });
        if (pursued_.empty()) {
            if (!known_.empty()) return;
            throw ConvergenceError(
                "no map was found between these surfaces; give landmarks, and look at both meshes");
        }
        judge_all();
        std::stable_sort(pursued_.begin(), pursued_.end(),
                         [](const Pursued& a, const Pursued& b) { return a.score() < b.score(); });
        const std::size_t before = pursued_.size();
        drop_worse_than(std::min(pursued_.front().score(), best_known_score()) + gap);
        log("{} of {} maps go on, rough scores {:.2f} to {:.2f}", pursued_.size(), before,
            pursued_.front().score(), pursued_.back().score());
    }
    /// But not the best, nor, where no map is known, the best that is elsewhere on most of the surfaces.
    void drop_worse_than(double worst) {
        std::vector<Pursued> kept;
        bool has_rival = !known_.empty();
        for (Pursued& one : pursued_) {
            const bool is_best = kept.empty(), is_rival = !is_best && !has_rival && differ(one, kept.front());
            has_rival |= is_rival;
            if (is_best || is_rival || one.score() <= worst) kept.push_back(std::move(one));
        }
        pursued_ = std::move(kept);
    }
    /// On this level.
    double best_known_score() const {
        const std::size_t level = pursued_.front().rough_scores.size() - 1;
        double best = std::numeric_limits<double>::infinity();
        for (const FinishedMap& map : known_)
            if (level < map.rough_scores.size()) best = std::min(best, map.rough_scores[level]);
        return best;
    }
    void judge_all() {
        parallel_for_each_index(pursued_.size(), std::size_t(1), [&](std::size_t n) { judge(pursued_[n]); });
    }
    bool first_is_clearly_best() const {
        constexpr double clearly = 1;
        const double first = pursued_.front().score();
        return std::all_of(pursued_.begin() + 1, pursued_.end(),
                           [&](const Pursued& other) { return other.score() > first + clearly; });
    }
    void judge(Pursued& one) const {
        one.images = vertex_images(one.solution, level(), context_);
        MapPair maps = to_maps(one.images, context_);
        loose_.lay_as_the_rest(maps);
        one.cues = appraisal_.cues(maps);
        one.rough_scores.push_back(rough_score(one.cues));
    }
    /// On most of the surfaces.
    bool differ(const Pursued& a, const Pursued& b) const {
        constexpr double most = 0.5;
        return difference(a.images, b.images, context_.A().surface, context_.B().surface) > most;
    }

    const PairContext& context_;
    const Appraisal& appraisal_;
    const FinishingOptions& options_;
    const std::vector<FinishedMap>& known_;
    const LooseComponents loose_;
    Descent descent_;
    const IroningOptions euclidean_ironing_;
    std::vector<Pursued> pursued_;
};

/// What a solution on the last Euclidean level, that of every vertex in space, says of both meshes' vertices.
MapPair read_out(const Solution& solution, const LevelPair& level, const PairContext& context,
                 double area_bound) {
    Plan plan;
    plan.plan = to_sample_plan(level, solution.plan, area_bound);
    plan.centre_A = solution.step.centres.row.leftCols<3>();
    plan.centre_B = solution.step.centres.column.leftCols<3>();
    plan.record.landmarks = context.landmarks();
    plan.record.landmark_weight = context.landmark_weight();
    return read_out(plan, context.A().surface, context.B().surface);
}

PinnedPair pinned(const PairContext& context) {
    PinnedPair pinned{VertexData<bool>(context.A().surface.mesh.vertex_count()),
                      VertexData<bool>(context.B().surface.mesh.vertex_count())};
    if (context.landmark_weight() == 1)
        for (const auto& [a, b] : context.landmarks()) pinned.A[a.index] = pinned.B[b.index] = true;
    return pinned;
}

bool are_the_same(const MapPair& a, const MapPair& b, const PairContext& context, double distinct) {
    const Surface &A = context.A().surface, &B = context.B().surface;
    constexpr double elsewhere = 0.1;  // units of sqrt(area); chosen by hand, not swept
    return share_elsewhere(positions(B.mesh, a.A_to_B), positions(B.mesh, b.A_to_B), A, elsewhere) +
               share_elsewhere(positions(A.mesh, a.B_to_A), positions(A.mesh, b.B_to_A), B, elsewhere) <
           2 * distinct;
}

}  // namespace

std::vector<FinishedMap> finish(const PairContext& context, const Appraisal& appraisal,
                                const std::vector<MapStart>& starts, const FinishingOptions& options,
                                const std::vector<FinishedMap>& known) {
    JointDescent descent(context, appraisal, options, known);
    std::vector<FinishedMap> finished;
    for (const Pursued& one : descent.run(starts)) {
        FinishedMap map{one.start,
                        read_out(one.solution, descent.level(), context, options.alternation.area_bound),
                        one.energy(), one.rough_scores};
        if (const int turned = descent.loose().lay_as_the_rest(map.maps))
            log("{} laid as the rest", counted(turned, "loose component", "loose components"));
        const auto is_same = [&](const FinishedMap& other) {
            return are_the_same(other.maps, map.maps, context, options.distinct);
        };
        if (std::any_of(known.begin(), known.end(), is_same)) continue;
        const auto same = std::find_if(finished.begin(), finished.end(), is_same);
        if (same == finished.end())
            finished.push_back(std::move(map));
        else
            same->start = std::min(same->start, map.start);
    }
    log("finished {} of {} maps", finished.size(), starts.size());
    UntanglingOptions untangling = options.untangling;
    untangling.opposed = appraisal.handedness().are_opposite();
    parallel_for_each_index(finished.size(), std::size_t(1), [&](std::size_t n) {
        untangle(finished[n].maps, context.A().surface.mesh, context.B().surface.mesh, pinned(context),
                 untangling);
    });
    return finished;
}

std::vector<Cues> cues_when_solved(const PairContext& context, const Appraisal& appraisal,
                                   const std::vector<MapStart>& starts, const FinishingOptions& options) {
    const std::vector<FinishedMap> none;
    JointDescent descent(context, appraisal, options, none);
    std::vector<Cues> cues;
    for (const Pursued& one : descent.run_until_first_is_best(starts)) cues.push_back(one.cues);
    return cues;
}

}  // namespace varimap
