#include "varimap/multilevel/solve_level.h"

#include "varimap/core/log.h"

namespace varimap {

namespace {

/// Appends a row to the trace and writes it to the log.
class Recorder {
  public:
    Recorder(const LevelPair& pair, int level_index, Trace& trace) : trace_(trace) {
        row_.level = level_index;
        row_.euclidean = pair.A.level.kind == LevelKind::euclidean;
        row_.iteration = -1;
        row_.samples_A = int(pair.A.level.samples.size());
        row_.samples_B = int(pair.B.level.samples.size());
    }

    void operator()(const Alternation& step) {
        ++row_.iteration;
        row_.sinkhorn_iterations = step.sinkhorn.iterations;
        row_.entries = step.entries;
        row_.gamma = step.gamma;
        row_.energy = step.energy;
        row_.marginal_error = step.sinkhorn.marginal_error;
        trace_.push_back(row_);
        log("level {} ({}, {} x {}) iteration {}: energy {:.6g}, {} entries, {} Sinkhorn iterations, "
            "marginal error {:.2g}",
            row_.level, row_.euclidean ? "Euclidean" : "diffusion", row_.samples_A, row_.samples_B,
            row_.iteration, row_.energy, step.entries, row_.sinkhorn_iterations, row_.marginal_error);
    }

  private:
    TraceRow row_;
    Trace& trace_;
};

}  // namespace

Solution solve_level(const PairContext& context, LevelPair& pair, const Start& start, int level_index,
                     const AlternationOptions& options, const IroningOptions& ironing, bool last,
                     Trace& trace) {
    Recorder record(pair, level_index, trace);
    const auto observe = [&](const Alternation& step) { record(step); };
    AlternatingMinimization minimization(pair.A.side, pair.B.side, options);
    minimization.start(start.centres, start.kept);
    minimization.run(observe);
    Ironing(context, pair, ironing).iron(minimization, observe);
    if (last) observe(minimization.tight_step());
    return minimization.take_solution();
}

SparseMatrix to_matrix(const Coupling& plan, const Eigen::VectorXd& row_mass,
                       const Eigen::VectorXd& column_mass) {
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
