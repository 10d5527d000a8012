#pragma once

#include <random>
#include <vector>

#include "stages/explore/starts.h"
#include "varimap/multilevel/descent.h"

namespace varimap {

/// Finding a map without landmarks. The coarsest levels have so few samples that solving them costs
/// milliseconds: many starts are solved there, and the better ones are promoted from level to level
/// (successive halving), with duplicates removed and the images of extremities exchanged on the way. The last
/// few are ranked by their energies on the last diffusion level and on the first Euclidean level together,
/// and by how well bending agrees, which tells near-symmetries that energy only just does: a person turned
/// about. Defaults were chosen by hand on the known pairs, not swept.
struct ExplorationOptions {
    int random_starts = 16;  ///< at each of the three coarsest levels worth it
    int seed = 1;
    int candidates = 3;      ///< maps that reach the last level
    double distinct = 0.05;  ///< maps closer than this are duplicates: squared distance of centres / variance
    double euclidean_exponent = 0.3;  ///< of the Euclidean energy in the ranking; 1 of the diffusion energy
    double bending_weight = 0.1;      ///< of the agreement of bending in the ranking
};

/// A map under trial: its solution at a level, and what is known of it there.
struct Trial {
    Solution solution;
    double euclidean_energy = 0;
    double bending_agreement = 0;  ///< bending_agreement.h
    PairOrientation orientation;   ///< from ironing's first level on
    double energy() const { return solution.step.energy; }
};

/// One exploration of a pair. Deterministic for a seed, for any number of threads.
class Exploration {
  public:
    Exploration(const PairContext& context, const ExplorationOptions& options,
                const AlternationOptions& alternation, const IroningOptions& ironing);

    /// Distinct maps at the last diffusion level, the best first, mirrored ones last.
    std::vector<Trial> run();
    /// The level pair they live on.
    const LevelPair& last_level() const { return descent_.level(); }
    /// log E_diffusion + exponent log E_euclidean - weight bending agreement.
    double score(const Trial& trial) const;

  private:
    void enter(int level);
    void add_starts();
    void add_swaps(int best);
    void prune();
    void log_pool(int level) const;
    void measure_finalists();
    Trial tried(const Start& start, bool ironed) const;
    void try_all(const std::vector<Start>& starts, bool ironed = true);

    const PairContext& context_;
    ExplorationOptions options_;
    AlternationOptions alternation_;
    Descent descent_;  ///< at the level where the pool is
    std::mt19937 random_;
    Levels extremities_;  ///< the coarse level whose samples are exchanged
    std::vector<Trial> pool_;
};

}  // namespace varimap
