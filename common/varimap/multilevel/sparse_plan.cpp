#include "varimap/multilevel/sparse_plan.h"

#include <algorithm>
#include <vector>

namespace varimap {

SparseMatrix to_matrix(const Coupling& plan, const Eigen::VectorXd& row_mass,
                       const Eigen::VectorXd& column_mass) {
    constexpr double negligible = 1e-3;  // a tenth of what spreads (AlternationOptions::support_threshold)
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

SamplePlan to_sample_plan(const LevelPair& pair, const Coupling& plan, double area_bound) {
    const Eigen::VectorXd &row_mass = pair.A.side.mass, &column_mass = pair.B.side.mass;
    return {.samples_A = pair.A.level.samples,
            .samples_B = pair.B.level.samples,
            .mass_A = row_mass,
            .mass_B = column_mass,
            .transported_A = row_sums(plan),
            .transported_B = column_sums(plan),
            .area_bound = area_bound,
            .entries = to_matrix(plan, row_mass, column_mass)};
}

}  // namespace varimap
