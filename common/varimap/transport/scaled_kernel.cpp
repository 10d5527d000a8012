#include "varimap/transport/private/scaled_kernel.h"

#include <algorithm>
#include <numeric>

#include "varimap/core/parallel.h"

namespace varimap {

namespace {

constexpr int lines_per_task = 1024;

}  // namespace

void ScaledKernel::CompressedLines::make_room(std::size_t entries) {
    if (entries <= index.size()) return;
    index.resize(2 * entries);
    value.resize(2 * entries);
}

/// Four partial sums hide the latency of the gathers.
double ScaledKernel::CompressedLines::line_times(int line, const Eigen::VectorXd& x) const {
    double sum[4] = {0, 0, 0, 0};
    int e = begin[line];
    for (; e + 4 <= begin[line + 1]; e += 4)
        for (int lane = 0; lane < 4; ++lane) sum[lane] += value[e + lane] * x[index[e + lane]];
    for (; e < begin[line + 1]; ++e) sum[0] += value[e] * x[index[e]];
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

ScaledKernel::ScaledKernel(const TransportProblem& p, const Coupling& absorbed, double negligible)
    : k_(absorbed) {
    const Support& s = p.support;
    const Eigen::VectorXd row_limit = negligible * p.row_mass, column_limit = negligible * p.column_mass;
    rows_.begin.reserve(s.rows() + 1);
    columns_.begin.assign(s.columns() + 1, 0);
    std::size_t kept = 0;
    for (int i = 0; i < s.rows(); ++i) {
        rows_.begin.push_back(int(kept));
        rows_.make_room(kept + std::size_t(s.row_begin[i + 1] - s.row_begin[i]));
        for (int e = s.row_begin[i]; e < s.row_begin[i + 1]; ++e) {
            const int j = s.column[e];
            // Written in any case, and kept or not without a branch, which would be guessed wrongly.
            rows_.index[kept] = j;
            rows_.value[kept] = absorbed.value[e];
            const bool counts = !(absorbed.value[e] < std::min(row_limit[i], column_limit[j]));
            columns_.begin[j + 1] += counts;
            kept += counts;
        }
    }
    rows_.begin.push_back(int(kept));
    rows_.index.resize(kept);
    rows_.value.resize(kept);
    transpose_rows();
}

void ScaledKernel::transpose_rows() {
    std::partial_sum(columns_.begin.begin(), columns_.begin.end(), columns_.begin.begin());
    std::vector<int> next(columns_.begin.begin(), columns_.begin.end() - 1);
    columns_.index.resize(rows_.index.size());
    columns_.value.resize(rows_.value.size());
    for (int i = 0; i + 1 < int(rows_.begin.size()); ++i)
        for (int e = rows_.begin[i]; e < rows_.begin[i + 1]; ++e) {
            const int place = next[rows_.index[e]]++;
            columns_.index[place] = i;
            columns_.value[place] = rows_.value[e];
        }
}

Eigen::VectorXd ScaledKernel::product(const CompressedLines& lines, const Eigen::VectorXd& x,
                                      const Eigen::VectorXd& background, double background_total) {
    Eigen::VectorXd y(background.size());
    parallel_for_each_index(0 + int(y.size()), lines_per_task,
                            [&](int i) { y[i] = lines.line_times(i, x) + background[i] * background_total; });
    return y;
}

Eigen::VectorXd ScaledKernel::times(const Eigen::VectorXd& w) const {
    return product(rows_, w, k_.row_background, k_.column_background.dot(w));
}

Eigen::VectorXd ScaledKernel::transposed_times(const Eigen::VectorXd& u) const {
    return product(columns_, u, k_.column_background, k_.row_background.dot(u));
}

}  // namespace varimap
