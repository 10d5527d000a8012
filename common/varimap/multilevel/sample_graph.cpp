#include "varimap/multilevel/sample_graph.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <set>

#include "varimap/core/parallel.h"

namespace varimap {

namespace {

/// Per sample: the samples of its neighbourhood and of the cells next to its own; mutual.
std::vector<std::set<int>> adjacent_samples(const Level& level, const GeodesicGraph& graph) {
    std::vector<std::set<int>> adjacent(level.samples.size());
    const auto join = [&](int a, int b) {
        if (a == b) return;
        adjacent[a].insert(b);
        adjacent[b].insert(a);
    };
    for (int v = 0; v < graph.vertex_count(); ++v)
        for (int e = graph.offset[v]; e < graph.offset[v + 1]; ++e)
            join(level.cell[v], level.cell[graph.target[e]]);
    for (int k = 0; k < level.weights.outerSize(); ++k)
        for (SparseMatrix::InnerIterator it(level.weights, k); it; ++it) join(k, int(it.col()));
    return adjacent;
}

using Edges = std::vector<std::pair<int, double>>;  ///< target vertex, length

Edges edges_of_sample(int sample, const std::set<int>& adjacent, const Level& level, GeodesicBall& ball) {
    Edges edges;
    ball.grow(level.samples[sample], [&](int v, double d) {
        const int other = level.cell[v];
        if (level.samples[other] == v && adjacent.count(other)) edges.emplace_back(v, d);
        return edges.size() < adjacent.size();
    });
    return edges;
}

Edges edge_to_own_sample(int vertex, const Level& level, GeodesicBall& ball) {
    Edges edges;
    ball.grow(vertex, [&](int v, double d) {
        if (v == level.samples[level.cell[vertex]]) edges.emplace_back(v, d);
        return edges.empty();
    });
    return edges;
}

}  // namespace

GeodesicGraph sample_graph(const Level& level, const GeodesicGraph& graph) {
    const auto adjacent = adjacent_samples(level, graph);
    std::vector<Edges> edges(graph.vertex_count());
    parallel_for_each_range(edges.size(), 256, [&](std::size_t begin, std::size_t end) {
        GeodesicBall ball(graph);
        for (int v = int(begin); v < int(end); ++v) {
            const int k = level.cell[v];
            edges[v] = level.samples[k] == v ? edges_of_sample(k, adjacent[k], level, ball)
                                             : edge_to_own_sample(v, level, ball);
        }
    });
    GeodesicGraph result;
    result.offset.push_back(0);
    for (const Edges& list : edges) {
        for (const auto& [target, length] : list) {
            result.target.push_back(target);
            result.length.push_back(length);
        }
        result.offset.push_back(int(result.target.size()));
    }
    return result;
}

const GeodesicGraph& SampleGraphs::A() const {
    make();
    return A_;
}

const GeodesicGraph& SampleGraphs::B() const {
    make();
    return B_;
}

void SampleGraphs::make() const {
    std::call_once(once_, [&] {
        // Isolated: a task that this thread took up meanwhile could ask for the graphs again, and wait for
        // itself.
        tbb::this_task_arena::isolate([&] {
            const Levels last = context_.diffusion_samples(context_.diffusion_levels() - 1);
            A_ = sample_graph(last.A, context_.graph_A());
            B_ = sample_graph(last.B, context_.graph_B());
        });
    });
}

}  // namespace varimap
