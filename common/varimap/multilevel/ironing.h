#pragma once

#include <functional>
#include <vector>

#include "varimap/multilevel/level_transfer.h"
#include "varimap/multilevel/orientation.h"
#include "varimap/multilevel/pair_context.h"

namespace varimap {

/// Keeping the map orientation-preserving (Sec. 4.4). At the end of a level the orientation of the map and of
/// its inverse is measured at every sample. A map that is reversed on most of the surface is reflected:
/// composed with the step to the opposite side of the target. Reversed patches are then ironed out: their
/// samples count less (omega) in the centres and in the cost, so that the well-oriented surroundings pull
/// them over. Patches that remain, typically whole mirrored feet or hands, are placed anew from their
/// surroundings (reanchoring.h).
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
    int maximum_samples = 20000;  ///< finer levels are left to the untangling of the final map
    int reflected_samples =
        1000;  ///< only on levels with at most that many samples: the reflected map starts from the full plan
};

/// Orientation of both directions at a level.
struct PairOrientation {
    Orientation A_to_B, B_to_A;
    double reversed_mass() const { return (A_to_B.reversed_mass + B_to_A.reversed_mass) / 2; }
};

class Ironing {
  public:
    Ironing(const PairContext& context, LevelPair& pair, const IroningOptions& options);

    /// Alternates on `minimization`, which must refer to the sides of this pair and have settled; on return
    /// it has settled again with full weights.
    void iron(AlternatingMinimization& minimization, const std::function<void(const Alternation&)>& observe);

    PairOrientation measure(const Solution& solution) const;

  private:
    void reflect(AlternatingMinimization& minimization,
                 const std::function<void(const Alternation&)>& observe);
    Centres reflected_centres(const PairOrientation& orientation, const Centres& centres) const;
    void damp(AlternatingMinimization& minimization, const std::function<void(const Alternation&)>& observe);
    void reanchor(AlternatingMinimization& minimization,
                  const std::function<void(const Alternation&)>& observe);
    void set_weights(const PairOrientation& orientation);
    void restore_weights();

    const PairContext& context_;
    LevelPair& pair_;
    IroningOptions options_;
    OrientedSurface oriented_A_, oriented_B_;
};

}  // namespace varimap
