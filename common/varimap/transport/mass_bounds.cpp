#include "varimap/transport/mass_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace varimap {

namespace {

/// clamp(phi a_i, lower_i, upper_i), as an expression.
auto clamped(const Eigen::ArrayXd& log_a, double log_phi, const MassBounds& bounds) {
    return (log_a + log_phi).min(700.0).exp().max(bounds.lower.array()).min(bounds.upper.array());
}

/// Between two neighbouring breakpoints: log phi.
struct Piece {
    double begin, end;
};

/// log phi of a linear piece in which clamped() sums to 1.
double solve_piece(const Eigen::ArrayXd& log_a, const Eigen::ArrayXd& log_lower,
                   const Eigen::ArrayXd& log_upper, const MassBounds& bounds, const Piece& piece) {
    const double middle = piece.begin + (piece.end - piece.begin) / 2;
    double held = 0, top = -std::numeric_limits<double>::infinity();
    for (Eigen::Index i = 0; i < log_a.size(); ++i) {
        if (log_a[i] + middle <= log_lower[i])
            held += bounds.lower[i];
        else if (log_a[i] + middle >= log_upper[i])
            held += bounds.upper[i];
        else
            top = std::max(top, log_a[i]);
    }
    double free = 0;
    for (Eigen::Index i = 0; i < log_a.size(); ++i)
        if (log_a[i] + middle > log_lower[i] && log_a[i] + middle < log_upper[i])
            free += std::exp(log_a[i] - top);
    // Rounding may leave a piece without free lines, or the last of them without mass: then any phi of it
    // does.
    if (!(free > 0) || !(held < 1)) return middle;
    return std::clamp(std::log((1 - held) / free) - top, piece.begin, piece.end);
}

constexpr double widest = 600;  ///< spread of logarithms; exp() holds 700

/// The numbers a_i themselves, by their largest: one exp() for all phi. None where they spread too far.
struct Scaled {
    double top;
    Eigen::ArrayXd a;

    explicit Scaled(const Eigen::ArrayXd& log_a) : top(log_a.maxCoeff()) {
        if (log_a.minCoeff() > top - widest) a = (log_a - top).exp();
    }
    bool exists() const { return a.size() > 0; }
    double scale(double log_phi) const { return std::exp(std::clamp(log_phi + top, -widest, widest)); }
};

/// Whether clamped() sums to less than 1. Nearly always that is beyond doubt without its exp().
bool is_below_one(const Eigen::ArrayXd& log_a, const Scaled& scaled, double log_phi,
                  const MassBounds& bounds) {
    constexpr double doubt = 1e-9;
    if (scaled.exists() && std::abs(log_phi + scaled.top) < widest) {
        const double sum =
            (scaled.a * scaled.scale(log_phi)).max(bounds.lower.array()).min(bounds.upper.array()).sum();
        if (std::abs(sum - 1) > doubt) return sum < 1;
    }
    return clamped(log_a, log_phi, bounds).sum() < 1;
}

/// What the lines carry for some phi: those at a bound, and the a_i of the others.
struct Carried {
    double held, free;
};

Carried carried(const Eigen::ArrayXd& a, double scale, const MassBounds& bounds) {
    constexpr int lanes = 4;  // partial sums, so that no addition waits for the one before
    double held[lanes] = {}, free[lanes] = {};
    const auto add = [&](Eigen::Index i, int lane) {
        const double mass = a[i] * scale, lower = bounds.lower[i], upper = bounds.upper[i];
        const bool is_low = mass <= lower, is_high = mass >= upper;
        held[lane] += is_low ? lower : is_high ? upper : 0;
        free[lane] += is_low || is_high ? 0 : a[i];
    };
    Eigen::Index i = 0;
    for (; i + lanes <= a.size(); i += lanes)
        for (int lane = 0; lane < lanes; ++lane) add(i + lane, lane);
    for (; i < a.size(); ++i) add(i, 0);
    return {(held[0] + held[1]) + (held[2] + held[3]), (free[0] + free[1]) + (free[2] + free[3])};
}

/// Newton's method for log phi, from 0 on, where Sinkhorn's iterations end: the sum is linear in phi between
/// breakpoints, so it is exact once it stays among the same ones. Where all lines are at their bounds, or a
/// step leaves the interval known to hold phi, that is searched or halved. None where it does not get there,
/// as among masses too far apart or all at their bounds.
std::optional<double> newton(const Scaled& scaled, const MassBounds& bounds) {
    constexpr int iterations = 40;
    if (!scaled.exists()) return {};
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double log_phi = 0, below = -infinity, above = infinity, stride = 0.25;
    for (int k = 0; k < iterations; ++k) {
        const double scale = scaled.scale(log_phi);
        const auto [held, free] = carried(scaled.a, scale, bounds);
        double next = free > 0 && held < 1 ? std::log((1 - held) / free) - scaled.top : infinity;
        if (next == log_phi) return log_phi;
        (held + free * scale < 1 ? below : above) = log_phi;
        if (!(below < next && next < above)) {
            next = above == infinity    ? below + stride
                   : below == -infinity ? above - stride
                                        : below + (above - below) / 2;
            stride *= 2;
        }
        log_phi = next;
    }
    return {};
}

}  // namespace

MassBounds MassBounds::around(const Eigen::VectorXd& mass, double factor) {
    return {mass / factor, mass * factor};
}

MassBounds MassBounds::within(const MassBounds& other) const {
    return {lower.cwiseMax(other.lower), upper.cwiseMin(other.upper)};
}

Eigen::VectorXd MassBounds::projected(const Eigen::VectorXd& mass) const {
    return exact() ? lower : bounded_masses(mass.array().log(), *this);
}

double MassBounds::excess(const Eigen::VectorXd& mass) const {
    const Eigen::ArrayXd above = mass.array() / upper.array(), below = lower.array() / mass.array();
    return std::max(0.0, std::max(above.maxCoeff(), below.maxCoeff()) - 1);
}

Eigen::VectorXd bounded_masses(const Eigen::ArrayXd& log_a, const MassBounds& bounds) {
    const Scaled scaled(log_a);
    if (const auto log_phi = newton(scaled, bounds)) return clamped(log_a, *log_phi, bounds);
    const Eigen::ArrayXd log_lower = bounds.lower.array().log(), log_upper = bounds.upper.array().log();
    std::vector<double> breakpoints(2 * log_a.size());
    Eigen::Map<Eigen::ArrayXd>(breakpoints.data(), log_a.size()) = log_lower - log_a;
    Eigen::Map<Eigen::ArrayXd>(breakpoints.data() + log_a.size(), log_a.size()) = log_upper - log_a;
    // Sorts only around the place looked for: every halving puts one breakpoint where sorting would.
    auto begin = breakpoints.begin(), after = breakpoints.end();
    while (begin < after) {
        const auto middle = begin + (after - begin) / 2;
        std::nth_element(begin, middle, after);
        if (is_below_one(log_a, scaled, *middle, bounds))
            begin = middle + 1;
        else
            after = middle;
    }
    // All at one end of their bounds: the sums of the bounds are 1 but for rounding.
    if (after == breakpoints.begin()) return bounds.lower;
    if (after == breakpoints.end()) return bounds.upper;
    const Piece piece{*std::prev(after), *after};
    return clamped(log_a, solve_piece(log_a, log_lower, log_upper, bounds, piece), bounds);
}

}  // namespace varimap
