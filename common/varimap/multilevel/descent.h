#pragma once

#include <optional>
#include <string>
#include <vector>

#include "varimap/multilevel/ironing.h"
#include "varimap/multilevel/level_transfer.h"
#include "varimap/results/trace.h"

namespace varimap {

/// The way down the levels of a pair (Alg. 5), for one map or for many: enters level by level, hands plans
/// down from the level before, solves there. Methods that are const may be called by several threads.
class Descent {
  public:
    /// Refers to the context.
    Descent(const PairContext& context, const AlternationOptions& alternation, const IroningOptions& ironing);
    Descent(const Descent&) = delete;

    /// Begins below the diffusion level that has these samples, that of a plan solved before, and returns its
    /// index. Nothing is embedded. Throws ArtifactError, which asks for `stage` to be rerun, if the pair has
    /// no such level.
    int resume(const std::vector<int>& samples_A, const std::vector<int>& samples_B,
               const std::string& stage);
    /// Goes on to a level.
    void enter(LevelPair level);
    const LevelPair& level() const { return level_; }
    /// Samples on the side that has fewer.
    int samples() const;

    /// Where a map starts at this level, from its plan on the level before.
    Start hand_down(const Coupling& coarse_plan) const;
    /// The alternating minimisation of this level (Alg. 1), settled.
    AlternatingMinimization settled(const Start& start, const Observer& observe = unobserved) const;
    /// The same with other landmarks than the level's.
    AlternatingMinimization settled(const Start& start, const Partners& partners,
                                    const Observer& observe = unobserved) const;
    const Ironing& ironing() const { return ironing_; }

  private:
    const PairContext& context_;
    AlternationOptions alternation_;
    Ironing ironing_;
    std::optional<Levels> resumed_;
    LevelPair level_;
    std::optional<LevelSwitch> switch_;  ///< to level_ from the one before, if there was one
};

/// The descent of one map, which is ironed (Sec. 4.4) and logged: every alternation adds a row to the trace.
class TracedDescent : public Descent {
  public:
    /// Goes on with a trace.
    TracedDescent(const PairContext& context, const AlternationOptions& alternation,
                  const IroningOptions& ironing, Trace trace = {})
        : Descent(context, alternation, ironing), trace_(std::move(trace)) {}

    struct Task {
        int index;           ///< of the level, over diffusion and Euclidean levels together
        bool ironed = true;  ///< where the options have it
        bool last = false;   ///< of a stage: ends with a plan that keeps the area bound tightly
    };
    Solution solve(const Start& start, const Task& task);

    Trace take_trace() { return std::move(trace_); }

  private:
    Trace trace_;
};

}  // namespace varimap
