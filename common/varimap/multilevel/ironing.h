#pragma once

#include <limits>
#include <optional>

#include "varimap/multilevel/orientation.h"
#include "varimap/multilevel/pair_context.h"
#include "varimap/multilevel/sample_graph.h"

namespace varimap {

/// Keeping the map orientation-preserving (Sec. 4.4). At the end of a level the orientation of the map and of
/// its inverse is measured at every sample. A map that is reversed on most of the surface is reflected:
/// composed with the step to the opposite side of the target. Reversed patches are then ironed out: their
/// samples count less (omega) in the centres and in the cost, so that the well-oriented surroundings pull
/// them over. Patches that remain, typically whole mirrored feet or hands, are placed anew from their
/// surroundings (reanchoring.h). But for omega, defaults were chosen by hand on the known pairs, not swept.
struct IroningOptions {
    bool enabled = true;
    int minimum_samples = 100;     ///< below that many samples orientation means nothing
    double omega = 0.01;           ///< weight of a reversed sample (the paper has 0.5, which measured worse)
    int maximum_rounds = 15;       ///< alternations with reduced weights, per level
    int patience = 3;              ///< rounds without progress after which a level is left as it is
    double tolerated_mass = 0.01;  ///< stop when less than this share of the mass is reversed
    double reflected_mass = 0.5;   ///< reflect when more than this share is reversed
    double reanchored_mass =
        0.008;  ///< reversed patches of at least that mass are placed anew from their surroundings
    /// How much log energy a map that reverses less may cost, for the share of the mass that is put right.
    double energy_for_mass = std::numeric_limits<double>::infinity();
    int maximum_samples = 20000;  ///< finer levels are left to the untangling of the final map
    int reflected_samples =
        1000;  ///< only on levels with at most that many samples: the reflected map starts from the full plan
};

/// The ironing of one pair, at any of its levels. May be used by several threads.
class Ironing {
  public:
    /// Refers to the context.
    Ironing(const PairContext& context, const IroningOptions& options);

    /// Alternates on `minimization`, which must be one of this level's sides and have settled; on return it
    /// has settled again, with all samples in full. Returns the orientation that the map has then, unless
    /// there is nothing to do at this level. Every alternation is observed.
    std::optional<PairOrientation> iron(const LevelPair& level, AlternatingMinimization& minimization,
                                        const Observer& observe) const;
    /// The same with other options.
    std::optional<PairOrientation> iron(const LevelPair& level, AlternatingMinimization& minimization,
                                        const Observer& observe, const IroningOptions& options) const;
    PairOrientation measure(const LevelPair& level, const Solution& solution) const;

    const IroningOptions& options() const { return options_; }

  private:
    class Run;

    const PairContext& context_;
    IroningOptions options_;
    OrientedSurface oriented_A_, oriented_B_;
    SampleGraphs sample_graphs_;
};

}  // namespace varimap
