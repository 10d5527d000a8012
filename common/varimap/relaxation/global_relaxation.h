#pragma once

#include <memory>
#include <vector>

#include "varimap/relaxation/relief_agreement.h"
#include "varimap/relaxation/soft_constraints.h"
#include "varimap/sliding/sliding_map.h"

namespace varimap {

/// Descent of the fold energy in all vertices at once: Newton's method in the tangent planes of the images
/// with the convex part of each face's Hessian, one sparse Cholesky factorisation per step. It moves what
/// local relaxation would need thousands of sweeps for: whole limbs along the target.
class GlobalRelaxation {
  public:
    /// Vertices with fixed[v] stay. Keeps references to the map and to `relief`, whose energy is added
    /// where given.
    GlobalRelaxation(SlidingMap& map, const VertexData<bool>& fixed, const ReliefAgreement* relief = nullptr);
    ~GlobalRelaxation();

    /// The constraints whose energy is added from now on; keeps a reference.
    void set_constraints(const std::vector<SoftConstraint>& constraints);

    /// One step, shorter where faces would get far worse by it; where that does not lower the energy, shorter
    /// for all vertices, until it does or is a hundredth. Returns the share of it lost, 0 where the map stays
    /// as it is.
    double step(const RobustEnergy& energy);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace varimap
