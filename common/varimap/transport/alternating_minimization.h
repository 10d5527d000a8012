#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "varimap/core/enum_names.h"
#include "varimap/transport/cost.h"
#include "varimap/transport/sinkhorn.h"

namespace varimap {

/// What is minimised where areas may change.
enum class AreaEnergy : int {
    transported = 0,  ///< m' = m and n' = n: samples weighted by the mass that they transport (cost.h)
    paper = 1,        ///< C' of Sec. 3.4, with relaxed masses
};
template <>
struct EnumNames<AreaEnergy> {
    static constexpr std::array names{"transported", "paper"};
};

/// The defaults were chosen by hand on the known pairs, not swept: the paper gives none of these numbers but
/// for gamma, which it takes as small as the largest cost / 1e4.
struct AlternationOptions {
    double tolerance = 1e-3;  ///< stop when the energy changes by less than this share (Alg. 1)
    int maximum_alternations = 30;
    double gamma_divisor = 300;  ///< gamma = largest instantiated cost / this
    double annealing_divisor =
        100;  ///< the first solve of a level starts from largest cost / this, in steps of 3
    double marginal_tolerance = 1e-2;  ///< Sinkhorn stops at this L1 error of the row sums
    int sinkhorn_iterations = 1000;
    double support_threshold =
        1e-2;               ///< entries below this share of their row's and column's mass do not spread
    double area_bound = 2;  ///< B = D^2: row and column sums stay within [m / sqrt(B), m sqrt(B)]
    AreaEnergy area_energy = AreaEnergy::transported;
    double mass_penalty = 0.1;      ///< rho within these bounds / largest instantiated cost
    double background_factor = 10;  ///< cost of entries that are not instantiated, times the largest cost
};

/// Kept entries of a plan, one sorted list of columns per row.
using KeptEntries = std::vector<std::vector<int>>;

/// What one alternation did.
struct Alternation {
    double energy;  ///< Eq. (3), or C', after all half-steps; without costs of descriptors
    double gamma;
    SinkhornReport sinkhorn;
    int entries;
};

/// Told of every alternation.
using Observer = std::function<void(const Alternation&)>;
inline void unobserved(const Alternation&) {}

/// State of a level: the plan, its potentials, the centres that belong to it, and the samples' own mean
/// images.
struct Solution {
    Coupling plan;
    Potentials potentials;
    RelaxedMasses relaxed;  ///< empty unless the energy is the paper's
    CentreStep step;
};

/// How much each sample counts in the means of the neighbourhoods that hold it, in [0, 1] (Sec. 4.4).
struct Damping {
    Eigen::VectorXd row, column;
};

/// Alg. 1 at one level: alternately solves for the plan on a support that follows it (Sec. 4.3) and relocates
/// the centres. The sides are referred to and stay as they are.
class AlternatingMinimization {
  public:
    AlternatingMinimization(const Side& X, const Side& Y, const AlternationOptions& options,
                            const Partners& partners = {})
        : X_(X), Y_(Y), partners_(partners), options_(options) {}

    /// Another one for the same sides, partners and options, without damping or a solution.
    AlternatingMinimization another() const { return {X_, Y_, options_, partners_}; }

    /// Begins from centres, which landmarks pull, on the enlarged kept entries; none: on all entries
    /// (coarsest level).
    void start(const Centres& centres, const KeptEntries& kept);
    /// The half-steps over the plan, over the relaxed masses (if the energy has them), and over the centres.
    Alternation step() { return step(Tightness::usual); }
    /// A step with a plan solved for more tightly and at last rounded, so that it keeps the area bound to
    /// within 0.1%. The centres are those of the plan before rounding. Throws ConvergenceError where the
    /// bound cannot be kept.
    Alternation tight_step() { return step(Tightness::tight); }
    /// From now on samples count this much in their neighbourhoods' means; with no value in full again.
    void set_damping(const std::optional<Damping>& damping);
    /// Steps until the energy of Eq. (3) settles: the one that is reported, though costs of descriptors have
    /// a part in what is minimised.
    void run(const Observer& observe);

    const Solution& solution() const { return solution_; }
    Solution take_solution() { return std::move(solution_); }
    /// Goes on from a solution found elsewhere, for the same sides.
    void adopt(Solution solution) { solution_ = std::move(solution); }
    const AlternationOptions& options() const { return options_; }

  private:
    AveragedSide averaged_X() const { return damped_X_ ? AveragedSide(X_, *damped_X_) : X_; }
    AveragedSide averaged_Y() const { return damped_Y_ ? AveragedSide(Y_, *damped_Y_) : Y_; }
    enum class Tightness { usual, tight };
    Alternation step(Tightness tightness);
    SinkhornReport solve_plan(Tightness tightness, double& gamma);
    void keep_bounds();
    void renew_support();

    const Side& X_;
    const Side& Y_;
    Partners partners_;
    AlternationOptions options_;
    std::optional<Averaging> damped_X_, damped_Y_;  ///< while samples are damped
    Solution solution_;
    bool fresh_ = true;  ///< no step since start(): the support is set and gamma is annealed
};

}  // namespace varimap
