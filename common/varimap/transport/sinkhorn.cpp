#include "varimap/transport/sinkhorn.h"

#include <algorithm>

#include "varimap/core/parallel.h"
#include "varimap/transport/private/log_domain.h"
#include "varimap/transport/private/scaled_kernel.h"

namespace varimap {

namespace {

/// Scalings beyond this range (or its inverse) are absorbed into the potentials.
constexpr double safe_scaling = 1e2;

bool in_safe_range(const Eigen::VectorXd& scaling) {
    return scaling.minCoeff() > 1 / safe_scaling && scaling.maxCoeff() < safe_scaling;
}

/// Scalings that solve one side given its products with the other's, for a kernel that has absorbed the
/// potentials.
Eigen::VectorXd scalings(const Projection& projection, const Eigen::VectorXd& mass,
                         const Eigen::VectorXd& absorbed, double gamma, const Eigen::VectorXd& product) {
    Eigen::ArrayXd log_ratio;
    if (!projection.exact()) log_ratio = (product.array() / mass.array()).log() - absorbed.array() / gamma;
    return projection.masses(log_ratio).cwiseQuotient(product);
}

/// Compares the row sums with those that one more row update would give.
bool is_done(const SinkhornOptions& options, const Eigen::VectorXd& row_sums,
             const Eigen::VectorXd& next_row_sums, SinkhornReport& report) {
    report.marginal_error = (row_sums - next_row_sums).lpNorm<1>();
    return report.marginal_error <= options.tolerance || report.iterations >= options.maximum_iterations;
}

/// The plan from the absorbed kernel and its scalings. Entries that the products left out become zero, so
/// that later sums can skip them.
void scale_plan(const TransportProblem& p, const Eigen::VectorXd& u, const Eigen::VectorXd& w,
                double negligible, Coupling& plan) {
    parallel_for_each_index(0 + p.support.rows(), rows_per_task, [&](int i) {
        for (int e = p.support.row_begin[i]; e < p.support.row_begin[i + 1]; ++e) {
            if (plan.value[e] == 0) continue;
            const int j = p.support.column[e];
            const bool counts = plan.value[e] >= negligible * std::min(p.row_mass[i], p.column_mass[j]);
            plan.value[e] = counts ? plan.value[e] * u[i] * w[j] : 0.0;
        }
    });
    plan.row_background = plan.row_background.cwiseProduct(u);
    plan.column_background = plan.column_background.cwiseProduct(w);
}

}  // namespace

SinkhornReport sinkhorn(const TransportProblem& p, const SinkhornOptions& options, Potentials& potentials,
                        Coupling& plan) {
    const double negligible = 1e-8 * options.tolerance;
    const LogKernel log_kernel(p);
    const Projections projections(p);
    SinkhornReport report;
    while (true) {
        // Absorb: after a full iteration in the log domain the kernel's entries are those of a plan.
        update_rows(p, projections, log_kernel, potentials);
        update_columns(p, projections, log_kernel, potentials);
        form_plan(p, log_kernel, potentials, negligible, plan);
        ++report.iterations;

        const ScaledKernel kernel(p, plan, negligible);
        Eigen::VectorXd u = Eigen::VectorXd::Ones(p.row_mass.size()),
                        w = Eigen::VectorXd::Ones(p.column_mass.size());
        bool safe = true, done = false;
        while (true) {
            const Eigen::VectorXd row = kernel.times(w);
            const Eigen::VectorXd next_u =
                scalings(projections.rows, p.row_mass, potentials.row, p.gamma, row);
            done = is_done(options, row.cwiseProduct(u), row.cwiseProduct(next_u), report);
            if (done) break;
            const Eigen::VectorXd next_w = scalings(projections.columns, p.column_mass, potentials.column,
                                                    p.gamma, kernel.transposed_times(next_u));
            safe = in_safe_range(next_u) && in_safe_range(next_w);
            if (!safe) break;
            u = next_u;
            w = next_w;
            ++report.iterations;
        }
        potentials.row.array() += p.gamma * u.array().log();
        potentials.column.array() += p.gamma * w.array().log();
        if (done) {
            scale_plan(p, u, w, negligible, plan);
            return report;
        }
    }
}

SinkhornReport sinkhorn_log_domain(const TransportProblem& p, const SinkhornOptions& options,
                                   Potentials& potentials, Coupling& plan) {
    const LogKernel kernel(p);
    const Projections projections(p);
    SinkhornReport report;
    update_rows(p, projections, kernel, potentials);
    while (true) {
        update_columns(p, projections, kernel, potentials);
        form_plan(p, kernel, potentials, 0, plan);
        ++report.iterations;
        Potentials next = potentials;
        update_rows(p, projections, kernel, next);
        const Eigen::VectorXd now = row_sums(plan);
        const Eigen::VectorXd change = ((next.row - potentials.row).array() / p.gamma).exp();
        // The potentials left behind are those that belong to the plan.
        if (is_done(options, now, now.cwiseProduct(change), report)) return report;
        potentials = std::move(next);
    }
}

void round_to_masses(const Eigen::VectorXd& row_mass, const Eigen::VectorXd& column_mass, Coupling& plan) {
    plan.row_background.setZero();
    plan.column_background.setZero();
    const Support& s = plan.support;
    const Eigen::VectorXd row_share = row_mass.cwiseQuotient(row_sums(plan)).cwiseMin(1);
    for (int i = 0; i < s.rows(); ++i)
        plan.value.segment(s.row_begin[i], s.row_begin[i + 1] - s.row_begin[i]) *= row_share[i];
    const Eigen::VectorXd column_share = column_mass.cwiseQuotient(column_sums(plan)).cwiseMin(1);
    for (int e = 0; e < s.entries(); ++e) plan.value[e] *= column_share[s.column[e]];
    plan.row_background = (row_mass - row_sums(plan)).cwiseMax(0);
    plan.column_background = (column_mass - column_sums(plan)).cwiseMax(0);
    const double missing = plan.row_background.sum();
    if (missing > 0) plan.row_background /= missing;
}

}  // namespace varimap
