#include "common/transport/sinkhorn.h"

#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "common/stage/parallel.h"

namespace varimap {

namespace {

constexpr int rows_per_task = 512;
constexpr double minus_infinity = -std::numeric_limits<double>::infinity();

/// log(exp(-c / gamma) - exp(-b / gamma)): the kernel of an instantiated entry in excess of the background, which
/// is added to all entries alike.
double log_excess(double cost, const TransportProblem& p) {
    const double gap = (p.background_cost - cost) / p.gamma;
    return -cost / p.gamma + (gap < 40 ? std::log1p(-std::exp(-gap)) : 0.0);
}

/// log sum_k mass_k exp(potential_k / gamma).
double log_total(const Eigen::VectorXd& mass, const Eigen::VectorXd& potential, double gamma) {
    const Eigen::ArrayXd exponent = potential.array() / gamma;
    const double top = exponent.maxCoeff();
    return top + std::log((mass.array() * (exponent - top).exp()).sum());
}

/// One side's log-domain update for one line (row or column): log sum over its entries and the background.
/// `entry(e)` gives (index on the other side, log excess kernel).
template <class Entry>
double log_sum_line(int begin, int end, double log_background, const Eigen::ArrayXd& other, const Entry& entry) {
    double top = log_background;
    for (int e = begin; e < end; ++e) {
        const auto [k, log_kernel] = entry(e);
        top = std::max(top, other[k] + log_kernel);
    }
    double sum = std::exp(log_background - top);
    for (int e = begin; e < end; ++e) {
        const auto [k, log_kernel] = entry(e);
        const double below_top = other[k] + log_kernel - top;
        if (below_top > -40) sum += std::exp(below_top);  // less is beyond the sum's last digit
    }
    return top + std::log(sum);
}

struct LogKernel {
    Eigen::VectorXd entry;  ///< log excess kernel per entry, row order
    double background;      ///< log of the background kernel

    explicit LogKernel(const TransportProblem& p) : entry(p.cost.size()), background(-p.background_cost / p.gamma) {
        parallel_for_each_index(Eigen::Index(0) + entry.size(), Eigen::Index(1 << 15),
                                [&](Eigen::Index e) { entry[e] = log_excess(p.cost[e], p); });
    }
};

void update_rows(const TransportProblem& p, const LogKernel& kernel, Potentials& q) {
    const Eigen::ArrayXd other = q.column.array() / p.gamma + p.column_mass.array().log();
    const double background = kernel.background + log_total(p.column_mass, q.column, p.gamma);
    parallel_for_each_index(0 + p.support.rows(), rows_per_task, [&](int i) {
        q.row[i] = -p.relaxation() * p.gamma * log_sum_line(p.support.row_begin[i], p.support.row_begin[i + 1], background, other,
                                           [&](int e) { return std::pair(p.support.column[e], kernel.entry[e]); });
    });
}

void update_columns(const TransportProblem& p, const LogKernel& kernel, Potentials& q) {
    const Eigen::ArrayXd other = q.row.array() / p.gamma + p.row_mass.array().log();
    const double background = kernel.background + log_total(p.row_mass, q.row, p.gamma);
    parallel_for_each_index(0 + p.support.columns(), rows_per_task, [&](int j) {
        q.column[j] =
            -p.relaxation() * p.gamma * log_sum_line(p.support.column_begin[j], p.support.column_begin[j + 1], background, other,
                                    [&](int e) {
                                        return std::pair(p.support.row[e], kernel.entry[p.support.by_row[e]]);
                                    });
    });
}

/// The plan that belongs to a pair of potentials.
void form_plan(const TransportProblem& p, const LogKernel& kernel, const Potentials& q, Coupling& plan) {
    const Eigen::ArrayXd u = q.row.array() / p.gamma + p.row_mass.array().log();
    const Eigen::ArrayXd w = q.column.array() / p.gamma + p.column_mass.array().log();
    plan.value.resize(p.cost.size());
    parallel_for_each_index(0 + p.support.rows(), rows_per_task, [&](int i) {
        const int begin = p.support.row_begin[i], count = p.support.row_begin[i + 1] - begin;
        for (int e = begin; e < begin + count; ++e) plan.value[e] = u[i] + w[p.support.column[e]] + kernel.entry[e];
        plan.value.segment(begin, count) = plan.value.segment(begin, count).array().exp();
    });
    // The background's logarithm is shared evenly so that neither factor leaves the range of doubles alone.
    const double shift = (u.maxCoeff() - w.maxCoeff() - kernel.background) / 2;
    plan.row_background = (u - shift).exp();
    plan.column_background = (w + shift + kernel.background).exp();
}

/// Scalings beyond this range (or its inverse) are absorbed into the potentials.
constexpr double safe_scaling = 1e2;

/// A sparse matrix in the order in which one of the two products reads it.
struct CompressedLines {
    std::vector<int> begin, index;
    std::vector<double> value;

    /// Four partial sums hide the latency of the gathers.
    double line_times(int line, const Eigen::VectorXd& x) const {
        double sum[4] = {0, 0, 0, 0};
        int e = begin[line];
        for (; e + 4 <= begin[line + 1]; e += 4)
            for (int lane = 0; lane < 4; ++lane) sum[lane] += value[e + lane] * x[index[e + lane]];
        for (; e < begin[line + 1]; ++e) sum[0] += value[e] * x[index[e]];
        return (sum[0] + sum[1]) + (sum[2] + sum[3]);
    }
};

/// The scaling phase: pi = D_u (K + r q') D_w for a kernel that already holds the potentials. Entries that cannot
/// matter while the scalings stay in their safe range are left out of the products: at small gamma that is
/// nine in ten.
class ScaledKernel {
  public:
    ScaledKernel(const TransportProblem& p, const Coupling& absorbed, double negligible) : k_(absorbed) {
        const Support& s = p.support;
        rows_.begin.reserve(s.rows() + 1);
        columns_.begin.assign(s.columns() + 1, 0);
        for (int i = 0; i < s.rows(); ++i) {
            rows_.begin.push_back(int(rows_.index.size()));
            for (int e = s.row_begin[i]; e < s.row_begin[i + 1]; ++e) {
                const int j = s.column[e];
                if (absorbed.value[e] < negligible * std::min(p.row_mass[i], p.column_mass[j])) continue;
                rows_.index.push_back(j);
                rows_.value.push_back(absorbed.value[e]);
                ++columns_.begin[j + 1];
            }
        }
        rows_.begin.push_back(int(rows_.index.size()));
        transpose_rows();
    }

    Eigen::VectorXd times(const Eigen::VectorXd& w) const {
        return product(rows_, w, k_.row_background, k_.column_background.dot(w));
    }
    Eigen::VectorXd transposed_times(const Eigen::VectorXd& u) const {
        return product(columns_, u, k_.column_background, k_.row_background.dot(u));
    }

  private:
    void transpose_rows() {
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

    static Eigen::VectorXd product(const CompressedLines& lines, const Eigen::VectorXd& x,
                                   const Eigen::VectorXd& background, double background_total) {
        Eigen::VectorXd y(background.size());
        parallel_for_each_index(0 + int(y.size()), 2 * rows_per_task,
                                [&](int i) { y[i] = lines.line_times(i, x) + background[i] * background_total; });
        return y;
    }

    const Coupling& k_;
    CompressedLines rows_, columns_;
};

bool in_safe_range(const Eigen::VectorXd& scaling) {
    return scaling.minCoeff() > 1 / safe_scaling && scaling.maxCoeff() < safe_scaling;
}

/// Scalings that solve one side given its products with the other's: (mass / product)^lambda, corrected for the
/// potentials that the kernel has absorbed.
class ScalingUpdate {
  public:
    ScalingUpdate(const TransportProblem& p, const Eigen::VectorXd& mass, const Eigen::VectorXd& absorbed)
        : mass_(mass), lambda_(p.relaxation()) {
        if (lambda_ < 1) correction_ = (-(1 - lambda_) / p.gamma * absorbed.array()).exp();
    }
    Eigen::VectorXd operator()(const Eigen::VectorXd& product) const {
        const Eigen::ArrayXd ratio = mass_.array() / product.array();
        if (lambda_ == 1) return ratio;
        return ratio.pow(lambda_) * correction_;
    }

  private:
    const Eigen::VectorXd& mass_;
    double lambda_;
    Eigen::ArrayXd correction_;
};

/// The plan from the absorbed kernel and its scalings. Entries that the products left out become zero, so that
/// later sums can skip them.
void scale_plan(const TransportProblem& p, const Eigen::VectorXd& u, const Eigen::VectorXd& w, double negligible,
                Coupling& plan) {
    parallel_for_each_index(0 + p.support.rows(), rows_per_task, [&](int i) {
        for (int e = p.support.row_begin[i]; e < p.support.row_begin[i + 1]; ++e) {
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
    SinkhornReport report;
    while (true) {
        // Absorb: after a full iteration in the log domain the kernel's entries are those of a plan.
        update_rows(p, log_kernel, potentials);
        update_columns(p, log_kernel, potentials);
        form_plan(p, log_kernel, potentials, plan);
        ++report.iterations;

        const ScaledKernel kernel(p, plan, negligible);
        Eigen::VectorXd u = Eigen::VectorXd::Ones(p.row_mass.size()), w = Eigen::VectorXd::Ones(p.column_mass.size());
        const ScalingUpdate update_u(p, p.row_mass, potentials.row), update_w(p, p.column_mass, potentials.column);
        bool safe = true, done = false;
        while (true) {
            const Eigen::VectorXd row = kernel.times(w);
            const Eigen::VectorXd next_u = update_u(row);
            report.marginal_error = row.cwiseProduct(u - next_u).lpNorm<1>();
            done = report.marginal_error <= options.tolerance || report.iterations >= options.maximum_iterations;
            if (done) break;
            const Eigen::VectorXd next_w = update_w(kernel.transposed_times(next_u));
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

SinkhornReport sinkhorn_log_domain(const TransportProblem& p, const SinkhornOptions& options, Potentials& potentials,
                                   Coupling& plan) {
    const LogKernel kernel(p);
    SinkhornReport report;
    update_rows(p, kernel, potentials);
    while (true) {
        update_columns(p, kernel, potentials);
        form_plan(p, kernel, potentials, plan);
        ++report.iterations;
        Potentials next = potentials;
        update_rows(p, kernel, next);
        const Eigen::ArrayXd change = ((next.row - potentials.row).array() / p.gamma).exp() - 1;
        report.marginal_error = (row_sums(plan).array() * change).abs().sum();
        // The potentials left behind are those that belong to the plan.
        if (report.marginal_error <= options.tolerance || report.iterations >= options.maximum_iterations) return report;
        potentials = std::move(next);
    }
}

}  // namespace varimap
