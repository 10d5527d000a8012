#pragma once

#include <random>
#include <vector>

#include "varimap/multilevel/descent.h"
#include "varimap/multilevel/matching.h"

namespace varimap {

/// Finding maps without landmarks. The coarsest levels have so few samples that solving them costs
/// milliseconds: many starts are solved there, and the better ones are promoted from level to level
/// (successive halving), with duplicates removed and the images of extremities exchanged on the way. Energies
/// of these levels do not tell the right map; they bring it among the few that are finished (finishing.h).
/// Defaults were chosen by hand on half of the known pairs, not swept.
struct ExplorationOptions {
    int random_starts = 16;  ///< at each of the three coarsest levels worth it
    int seed = 1;
    int tip_starts = 32;     ///< from matched ends of limbs
    int axes_maps = 0;       ///< maps from principal axes, besides the others
    int coarse = 10;         ///< maps that go on from levels with fewer than a hundred samples
    int candidates = 6;      ///< maps that reach the last level
    int last_samples = 150;  ///< the first level with so many samples is the last
    double distinct = 0.2;   ///< maps closer than this are duplicates: squared distance of centres / variance
    double area_bound =
        2;  ///< with exact areas the cheapest map of shapes of other proportions is a wrong one
};

/// A map under trial: its solution at a level, and what is known of it there.
struct Trial {
    Solution solution;
    PairOrientation orientation;  ///< from ironing's first level on
    double energy() const { return solution.step.energy; }
    bool is_mirrored() const;
};

/// How far an exploration has come.
struct ExplorationProgress {
    int levels = 0;           ///< that are done
    std::vector<Trial> pool;  ///< on the last of these
    std::mt19937 random;
    int levels_with_starts = 0, levels_with_swaps = 0;
    Levels extremities;  ///< the coarse level whose samples are exchanged
};

/// One exploration of a pair. Deterministic for a seed, for any number of threads.
class Exploration {
  public:
    Exploration(const PairContext& context, const ExplorationOptions& options,
                const AlternationOptions& alternation, const IroningOptions& ironing);

    /// The levels too coarse to see orientation, and in any case not the last one. What they bring is the
    /// same for the mirror image of either surface.
    ExplorationProgress coarse_levels();
    /// Goes on from there. Distinct maps at the last level, the one of least energy first, mirrored ones
    /// last.
    std::vector<Trial> go_on(ExplorationProgress progress);
    /// Those from principal axes alone (axes_maps of them), at the last level, where they begin.
    std::vector<Trial> from_axes();
    /// The map that landmarks lead to from the coarsest level on, as in varimap-diffuse.
    Trial follow_landmarks();
    /// Images of all vertices, by a map of the level that is now the last one.
    VertexImages images(const Trial& trial) const;

  private:
    bool is_last(int level) const;
    /// Begins below so many levels.
    void resume_below(int levels);
    void explore_next_level();
    void enter(int level);
    void add_starts();
    void add_tip_starts();
    void add_axes_starts();
    void add_swaps(int best);
    /// Keeps so many that differ, and the best that are turned against the best of all.
    void prune(int keep);
    /// Where the samples of A go: those of B that most of their mass goes to.
    Points places(const Trial& trial) const;
    /// Degrees of the rotation that takes the places of one map nearest to those of another.
    double turn(const Points& best, const Points& other) const;
    void log_pool() const;
    enum class Folds { ironed, left };
    Trial tried(const Start& start, Folds folds) const;
    void try_all(const std::vector<Start>& starts, Folds folds = Folds::ironed);

    const PairContext& context_;
    ExplorationOptions options_;
    AlternationOptions alternation_;
    Descent descent_;  ///< at the level where the pool is
    ExplorationProgress progress_;
};

/// Solved no more precisely than telling maps apart takes.
AlternationOptions for_comparison(AlternationOptions options, double area_bound);

}  // namespace varimap
