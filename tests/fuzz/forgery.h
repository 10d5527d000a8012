#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <random>
#include <utility>
#include <vector>

#include "varimap/core/linear_algebra.h"
#include "varimap/results/candidates.h"
#include "varimap/results/diffusion.h"
#include "varimap/results/plan.h"
#include "varimap/results/surface_map.h"
#include "varimap/spectral/eigenbasis.h"
#include "varimap/spectral/hierarchy.h"
#include "varimap/surface/surface.h"

namespace varimap::fuzz {

/// Alters artifacts as an attacker would who knows their form: numbers are exchanged, made extreme, repeated,
/// lost. What comes out has the form of an artifact, so that most of it is refused, if at all, for what it
/// says.
class Forger {
  public:
    explicit Forger(std::uint64_t number) : random_(number) {}

    void operator()(Surface& surface);
    void operator()(Basis& basis);
    void operator()(Hierarchy& hierarchy);
    void operator()(Candidates& candidates);
    void operator()(Diffusion& diffusion);
    void operator()(Plan& plan);
    void operator()(SurfaceMap& map);

    std::size_t below(std::size_t count) { return count == 0 ? 0 : std::size_t(random_() % count); }

  private:
    template <class Matrix>
    void reals(Matrix& matrix);
    void masses(Eigen::VectorXd& masses);
    void integers(std::vector<int>& values);
    void triangles(Faces& faces);
    void points(PointMap& points);
    void pairs(PointPairs& pairs);
    void sparse(SparseMatrix& matrix);
    void real(double& value);
    void integer(int& value, int near);
    void flag(bool& value) { value = !value; }
    void level(Level& level);
    void sample_plan(SamplePlan& plan);
    void pair(SolvedPair& pair);
    void trace(Trace& trace);
    void reshape(Surface& surface);
    void one_of(const std::vector<std::function<void()>>& edits, std::size_t at_most = 3);

    std::mt19937_64 random_;
};

}  // namespace varimap::fuzz
