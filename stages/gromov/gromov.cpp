#include "stages/gromov/gromov.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "varimap/core/error.h"
#include "varimap/core/index_set.h"
#include "varimap/core/log.h"
#include "varimap/geodesics/geodesic_graph.h"
#include "varimap/multilevel/sparse_plan.h"
#include "varimap/transport/sinkhorn.h"

namespace varimap {

namespace {

RowMatrix all_distances(const Domain& domain) {
    const GeodesicGraph graph(domain);
    const RowMatrix there = distances_from_each(graph, all_indices(graph.vertex_count()));
    return (there + there.transpose()) / 2;
}

/// Cost of each entry for the plan before: sum_kl (d_ik - d'_jl)^2 pi_kl, with the plan's exact masses.
class GromovCost {
  public:
    GromovCost(RowMatrix A, RowMatrix B, const Eigen::VectorXd& mass_A, const Eigen::VectorXd& mass_B)
        : A_(std::move(A)),
          B_(std::move(B)),
          square_A_(A_.cwiseAbs2() * mass_A),
          square_B_(B_.cwiseAbs2() * mass_B) {}

    RowMatrix of(const RowMatrix& plan) const {
        RowMatrix cost = -2 * (A_ * plan) * B_;
        cost.colwise() += square_A_;
        cost.rowwise() += square_B_.transpose();
        return cost;
    }
    double diameter() const { return std::max(A_.maxCoeff(), B_.maxCoeff()); }

  private:
    RowMatrix A_, B_;
    Eigen::VectorXd square_A_, square_B_;
};

void require_few(const Domain& domain) {
    constexpr int most_points = 4000;
    if (domain.mass.size() > most_points)
        throw UsageError(
            fmt::format("{} points are too many for all distances, {} are allowed; coarsen the surface",
                        domain.mass.size(), most_points));
}

Plan to_plan(const Coupling& plan, const Domain& A, const Domain& B, Trace trace) {
    Plan result;
    SamplePlan& samples = result.plan;
    samples.samples_A = all_indices(A.mass.size()), samples.samples_B = all_indices(B.mass.size());
    samples.mass_A = A.mass, samples.mass_B = B.mass;
    samples.transported_A = row_sums(plan), samples.transported_B = column_sums(plan);
    samples.entries = to_matrix(plan, A.mass, B.mass);
    result.centre_A = row_barycentres(plan, B.mesh.vertices);
    result.centre_B = column_barycentres(plan, A.mesh.vertices);
    result.trace = std::move(trace);
    return result;
}

}  // namespace

Plan gromov_wasserstein(const Domain& A, const Domain& B, const GromovParams& params) {
    require_few(A);
    require_few(B);
    const GromovCost costs(all_distances(A), all_distances(B), A.mass, B.mass);
    const double gamma = params.regularisation * costs.diameter() * costs.diameter();
    const Support support = Support::dense(int(A.mass.size()), int(B.mass.size()));
    Coupling coupling{support, {}, {}, {}};
    Potentials potentials = Potentials::zero(support.rows(), support.columns());
    RowMatrix plan = A.mass * B.mass.transpose();
    Trace trace;
    double before = std::numeric_limits<double>::infinity();
    for (int n = 0; n < params.iterations; ++n) {
        const RowMatrix matrix = costs.of(plan);
        const Eigen::VectorXd cost = matrix.reshaped<Eigen::RowMajor>();
        const SinkhornReport report =
            sinkhorn({support, cost, A.mass, B.mass, gamma, 2 * cost.maxCoeff() + 1e3 * gamma}, {1e-6, 20000},
                     potentials, coupling);
        plan = coupling.value.reshaped<Eigen::RowMajor>(plan.rows(), plan.cols());
        const double energy = costs.of(plan).cwiseProduct(plan).sum();
        trace.push_back({0, 1, n, int(plan.rows()), int(plan.cols()), report.iterations, double(plan.size()),
                         gamma, energy, report.marginal_error});
        if (std::abs(before - energy) <= params.tolerance * energy) break;
        before = energy;
    }
    log("{} transport problems, energy {:.6g}", trace.size(), trace.back().energy);
    return to_plan(coupling, A, B, std::move(trace));
}

}  // namespace varimap
