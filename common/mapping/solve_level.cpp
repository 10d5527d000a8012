#include "common/mapping/solve_level.h"

#include "common/stage/log.h"

namespace varimap {

Solution solve_level(const LevelPair& pair, const Start& start, int level_index, const AlternationOptions& options,
                     std::vector<TraceRow>& trace) {
    const bool euclidean = pair.A.level.kind == LevelKind::euclidean;
    return minimize_alternatingly(pair.A.side, pair.B.side, start.centres, start.kept, options,
                                  [&](const Alternation& step) {
        TraceRow row;
        row.level = level_index;
        row.euclidean = euclidean;
        row.iteration = step.iteration;
        row.samples_A = int(pair.A.level.samples.size());
        row.samples_B = int(pair.B.level.samples.size());
        row.sinkhorn_iterations = step.sinkhorn.iterations;
        row.entries = step.entries;
        row.gamma = step.gamma;
        row.energy = step.energy;
        row.marginal_error = step.sinkhorn.marginal_error;
        trace.push_back(row);
        log("level {} ({}, {} x {}) iteration {}: energy {:.6g}, {} entries, {} Sinkhorn iterations, marginal error {:.2g}",
            level_index, euclidean ? "Euclidean" : "diffusion", row.samples_A, row.samples_B, step.iteration,
            step.energy, step.entries, step.sinkhorn.iterations, step.sinkhorn.marginal_error);
    });
}

SparseMatrix to_matrix(const Coupling& plan, const Eigen::VectorXd& row_mass, const Eigen::VectorXd& column_mass) {
    constexpr double negligible = 1e-3;
    const Support& s = plan.support;
    SparseMatrix matrix(s.rows(), s.columns());
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < s.rows(); ++i)
        for (int e = s.row_begin[i]; e < s.row_begin[i + 1]; ++e)
            if (plan.value[e] >= negligible * std::min(row_mass[i], column_mass[s.column[e]]))
                entries.emplace_back(i, s.column[e], plan.value[e]);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

Coupling to_coupling(const SparseMatrix& plan) {
    Coupling coupling;
    std::vector<std::vector<int>> columns(plan.rows());
    coupling.value.resize(plan.nonZeros());
    Eigen::Index next = 0;
    for (int i = 0; i < plan.outerSize(); ++i)
        for (SparseMatrix::InnerIterator it(plan, i); it; ++it) {
            columns[i].push_back(int(it.col()));
            coupling.value[next++] = it.value();
        }
    coupling.support = Support(std::move(columns), int(plan.cols()));
    coupling.row_background = Eigen::VectorXd::Zero(plan.rows());
    coupling.column_background = Eigen::VectorXd::Zero(plan.cols());
    return coupling;
}

}  // namespace varimap
