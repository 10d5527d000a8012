#include <benchmark/benchmark.h>

#include <cmath>

#include "benchmarks/example.h"
#include "varimap/transport/sinkhorn.h"

namespace varimap::benchmarks {
namespace {

constexpr int iterations = 20;

template <class Method>
void run_sinkhorn(benchmark::State& state, const Method& method) {
    const Example& e = example(int(state.range(0)));
    const double largest = e.cost.maxCoeff();
    const TransportProblem problem{e.support,          e.cost,        e.pair.A.side.mass,
                                   e.pair.B.side.mass, largest / 300, 10 * largest};
    Coupling plan;
    plan.support = e.support;
    for (auto _ : state) {
        Potentials potentials = Potentials::zero(e.support.rows(), e.support.columns());
        method(problem, {0, iterations}, potentials, plan);
        benchmark::DoNotOptimize(plan.value.data());
    }
    state.SetItemsProcessed(state.iterations() * iterations * e.support.entries());
}

/// Items: entries of the support times iterations.
void sinkhorn_iterations(benchmark::State& state) {
    run_sinkhorn(state, sinkhorn);
}
void sinkhorn_iterations_in_log_domain(benchmark::State& state) {
    run_sinkhorn(state, sinkhorn_log_domain);
}

/// Items: entries of the support.
void cost(benchmark::State& state) {
    const Example& e = example(int(state.range(0)));
    for (auto _ : state)
        benchmark::DoNotOptimize(CostFactors(e.pair.A.side, e.pair.B.side, e.centres).on(e.support));
    state.SetItemsProcessed(state.iterations() * e.support.entries());
}

/// A solved plan of the example.
Coupling solved_plan(const Example& e) {
    const double largest = e.cost.maxCoeff();
    Coupling plan;
    plan.support = e.support;
    Potentials potentials = Potentials::zero(e.support.rows(), e.support.columns());
    sinkhorn({e.support, e.cost, e.pair.A.side.mass, e.pair.B.side.mass, largest / 300, 10 * largest},
             {1e-2, 1000}, potentials, plan);
    return plan;
}

/// Items: entries of the grown support.
void support_growth(benchmark::State& state) {
    const Example& e = example(int(state.range(0)));
    const Coupling plan = solved_plan(e);
    long entries = 0;
    for (auto _ : state) {
        const auto kept = significant_entries(plan, e.pair.A.side.mass, e.pair.B.side.mass, 1e-2);
        entries = enlarged(kept, e.pair.A.side.weights, e.pair.B.side.weights).entries();
    }
    state.SetItemsProcessed(state.iterations() * entries);
}

/// Items: samples.
void centres(benchmark::State& state) {
    const Example& e = example(int(state.range(0)));
    const Coupling plan = solved_plan(e);
    for (auto _ : state) benchmark::DoNotOptimize(update_centres(e.pair.A.side, e.pair.B.side, plan).energy);
    state.SetItemsProcessed(state.iterations() * (e.support.rows() + e.support.columns()));
}

/// Masses drawn into bounds of a factor of 1.4, from numbers that spread by a hundred. Items: masses. Each
/// takes two exp(), and one multiplication and two comparisons for each of some ten values of phi.
void masses_in_bounds(benchmark::State& state) {
    const Eigen::Index count = state.range(0);
    const MassBounds bounds = MassBounds::around(Eigen::VectorXd::Constant(count, 1. / double(count)), 1.4);
    Eigen::ArrayXd log_a(count);
    for (Eigen::Index i = 0; i < count; ++i) log_a[i] = 2.3 * std::sin(double(i) * double(i));
    for (auto _ : state) benchmark::DoNotOptimize(bounded_masses(log_a, bounds).data());
    state.SetItemsProcessed(state.iterations() * count);
}

BENCHMARK(sinkhorn_iterations)->Apply(at_sizes);
BENCHMARK(sinkhorn_iterations_in_log_domain)->Apply(at_sizes);
BENCHMARK(cost)->Apply(at_sizes);
BENCHMARK(support_growth)->Apply(at_sizes);
BENCHMARK(centres)->Apply(at_sizes);
BENCHMARK(masses_in_bounds)->Apply(at_sizes);

}  // namespace
}  // namespace varimap::benchmarks
