#include "varimap/transport/private/log_domain.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "varimap/core/parallel.h"

namespace varimap {

namespace {

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

/// Potentials that make a side's lines carry their projected masses.
Eigen::VectorXd projected_potentials(const Projection& projection, const Eigen::VectorXd& mass,
                                     const Eigen::ArrayXd& log_ratio, double gamma) {
    return gamma * ((projection.masses(log_ratio).array() / mass.array()).log() - log_ratio);
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

}  // namespace

LogKernel::LogKernel(const TransportProblem& p)
    : entry(p.cost.size()), background(-p.background_cost / p.gamma) {
    parallel_for_each_index(Eigen::Index(0) + entry.size(), Eigen::Index(1 << 15),
                            [&](Eigen::Index e) { entry[e] = log_excess(p.cost[e], p); });
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

}  // namespace varimap
