#include "varimap/transport/sinkhorn.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include "varimap/core/parallel.h"

namespace varimap {

namespace {

constexpr int rows_per_task = 512;

/// log(exp(-c / gamma) - exp(-b / gamma)): the kernel of an instantiated entry in excess of the background,
/// which is added to all entries alike.
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
/// `term(e)` gives an entry's potential on the other side and log excess kernel, together; what it gathers
/// from all over memory is kept in `terms`.
template <class Term>
double log_sum_line(int begin, int end, double log_background, const Term& term, std::vector<double>& terms) {
    terms.resize(std::size_t(end - begin));
    double top = log_background;
    for (int e = begin; e < end; ++e) {
        const double t = terms[std::size_t(e - begin)] = term(e);
        top = std::max(top, t);
    }
    double sum = std::exp(log_background - top);
    for (const double t : terms) {
        const double below_top = t - top;
        if (below_top > -40) sum += std::exp(below_top);  // less is beyond the sum's last digit
    }
    return top + std::log(sum);
}

/// Calls body(line, workspace) for every line, on several threads.
template <class Body>
void for_each_line(int lines, const Body& body) {
    parallel_for_each_range(std::size_t(lines), rows_per_task, [&](std::size_t begin, std::size_t end) {
        std::vector<double> workspace;
        for (std::size_t i = begin; i < end; ++i) body(int(i), workspace);
    });
}

struct LogKernel {
    Eigen::VectorXd entry;  ///< log excess kernel per entry, row order
    double background;      ///< log of the background kernel

    explicit LogKernel(const TransportProblem& p)
        : entry(p.cost.size()), background(-p.background_cost / p.gamma) {
        parallel_for_each_index(Eigen::Index(0) + entry.size(), Eigen::Index(1 << 15),
                                [&](Eigen::Index e) { entry[e] = log_excess(p.cost[e], p); });
    }
};

/// The masses that one side's lines take on in the KL projection onto their bounds. Without bounds and total,
/// a line that carries s before the projection and should carry m would take on m^lambda s^(1 - lambda),
/// lambda = rho / (rho + gamma); the total's multiplier scales these by a common phi, and the bounds clamp
/// them.
class Projection {
  public:
    Projection(const Eigen::VectorXd& mass, const MassBounds& bounds, const TransportProblem& p)
        : bounds_(bounds), exact_(bounds.exact()), lambda_(p.mass_penalty / (p.mass_penalty + p.gamma)) {
        if (!exact_) log_mass_ = mass.array().log();
    }
    bool exact() const { return exact_; }
    /// Given log(s / m) for every line, with the side's own potentials taken out.
    Eigen::VectorXd masses(const Eigen::ArrayXd& log_ratio) const {
        return exact_ ? bounds_.lower : bounded_masses(log_mass_ + (1 - lambda_) * log_ratio, bounds_);
    }

  private:
    const MassBounds& bounds_;
    bool exact_;
    double lambda_;
    Eigen::ArrayXd log_mass_;
};

/// A problem with the projections of its two sides.
struct Projections {
    Projection rows, columns;
    explicit Projections(const TransportProblem& p)
        : rows(p.row_mass, p.row_bounds, p), columns(p.column_mass, p.column_bounds, p) {}
};

/// Potentials that make a side's lines carry their projected masses.
Eigen::VectorXd projected_potentials(const Projection& projection, const Eigen::VectorXd& mass,
                                     const Eigen::ArrayXd& log_ratio, double gamma) {
    return gamma * ((projection.masses(log_ratio).array() / mass.array()).log() - log_ratio);
}

void update_rows(const TransportProblem& p, const Projections& projections, const LogKernel& kernel,
                 Potentials& q) {
    const Eigen::ArrayXd other = q.column.array() / p.gamma + p.column_mass.array().log();
    const double background = kernel.background + log_total(p.column_mass, q.column, p.gamma);
    Eigen::ArrayXd log_ratio(p.support.rows());
    for_each_line(p.support.rows(), [&](int i, std::vector<double>& terms) {
        log_ratio[i] = log_sum_line(
            p.support.row_begin[i], p.support.row_begin[i + 1], background,
            [&](int e) { return other[p.support.column[e]] + kernel.entry[e]; }, terms);
    });
    q.row = projected_potentials(projections.rows, p.row_mass, log_ratio, p.gamma);
}

void update_columns(const TransportProblem& p, const Projections& projections, const LogKernel& kernel,
                    Potentials& q) {
    const Eigen::ArrayXd other = q.row.array() / p.gamma + p.row_mass.array().log();
    const double background = kernel.background + log_total(p.row_mass, q.row, p.gamma);
    Eigen::ArrayXd log_ratio(p.support.columns());
    for_each_line(p.support.columns(), [&](int j, std::vector<double>& terms) {
        log_ratio[j] = log_sum_line(
            p.support.column_begin[j], p.support.column_begin[j + 1], background,
            [&](int e) { return other[p.support.row[e]] + kernel.entry[p.support.by_row[e]]; }, terms);
    });
    q.column = projected_potentials(projections.columns, p.column_mass, log_ratio, p.gamma);
}

/// exp() of the numbers from `begin` to `end`, in their place, but 0 for those far below `least`: at small
/// gamma nine in ten, which cost no exp() then.
void exponentiate(double* begin, double* end, double least) {
    const double limit = std::log(least) - 1;
    const auto is_far_below = [&](double x) { return x < limit; };
    double* x = begin;
    const auto one = [&] { *x = is_far_below(*x) ? 0 : std::exp(*x), ++x; };
    if (x < end && reinterpret_cast<std::uintptr_t>(x) % 16 != 0) one();
    for (; x + 2 <= end; x += 2) {
        Eigen::Map<Eigen::Array2d, Eigen::Aligned16> both(x);
        if (is_far_below(x[0]) && is_far_below(x[1]))
            both.setZero();
        else
            both = both.exp();
    }
    if (x < end) one();
}

/// The plan that belongs to a pair of potentials. Entries below `negligible` times the mass of their row or
/// column may be 0.
void form_plan(const TransportProblem& p, const LogKernel& kernel, const Potentials& q, double negligible,
               Coupling& plan) {
    const Eigen::ArrayXd u = q.row.array() / p.gamma + p.row_mass.array().log();
    const Eigen::ArrayXd w = q.column.array() / p.gamma + p.column_mass.array().log();
    const double lightest_column = p.column_mass.minCoeff();
    plan.value.resize(p.cost.size());
    parallel_for_each_index(0 + p.support.rows(), rows_per_task, [&](int i) {
        const int begin = p.support.row_begin[i], end = p.support.row_begin[i + 1];
        for (int e = begin; e < end; ++e) plan.value[e] = u[i] + w[p.support.column[e]] + kernel.entry[e];
        exponentiate(plan.value.data() + begin, plan.value.data() + end,
                     negligible * std::min(p.row_mass[i], lightest_column));
    });
    // Most backgrounds are too little to count anywhere, and their products not normal numbers, which take a
    // hundred times as long.
    constexpr double nothing = 1e-100;
    const double largest_u = u.maxCoeff(), largest_w = w.maxCoeff();
    if (largest_u + largest_w + kernel.background < std::log(nothing)) {
        plan.row_background.setZero(u.size());
        plan.column_background.setZero(w.size());
        return;
    }
    // The background's logarithm is shared evenly so that neither factor leaves the range of doubles alone.
    const double shift = (largest_u - largest_w - kernel.background) / 2;
    plan.row_background = (u - shift).exp();
    plan.column_background = (w + shift + kernel.background).exp();
}

/// Scalings beyond this range (or its inverse) are absorbed into the potentials.
constexpr double safe_scaling = 1e2;

/// A sparse matrix in the order in which one of the two products reads it.
struct CompressedLines {
    std::vector<int> begin, index;
    std::vector<double> value;

    void make_room(std::size_t entries) {
        if (entries <= index.size()) return;
        index.resize(2 * entries);
        value.resize(2 * entries);
    }
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

/// The scaling phase: pi = D_u (K + r q') D_w for a kernel that already holds the potentials. Entries that
/// cannot matter while the scalings stay in their safe range are left out of the products: at small gamma
/// that is nine in ten.
class ScaledKernel {
  public:
    ScaledKernel(const TransportProblem& p, const Coupling& absorbed, double negligible) : k_(absorbed) {
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
        parallel_for_each_index(0 + int(y.size()), 2 * rows_per_task, [&](int i) {
            y[i] = lines.line_times(i, x) + background[i] * background_total;
        });
        return y;
    }

    const Coupling& k_;
    CompressedLines rows_, columns_;
};

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
