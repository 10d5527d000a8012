#include <benchmark/benchmark.h>

#include "benchmarks/example.h"
#include "varimap/geodesics/triangle_strip.h"
#include "varimap/mesh/closest_point.h"
#include "varimap/mesh/topology.h"
#include "varimap/spectral/sampling.h"

namespace varimap::benchmarks {
namespace {

/// Cells grow in straight distances. Items: vertices; half of them become samples.
void sampling(benchmark::State& state) {
    const Example& e = example(int(state.range(0)));
    const auto grow = [&](int sample, const auto& claim) {
        std::vector<int> queue;
        if (claim(sample, 0)) queue.push_back(sample);
        for (std::size_t head = 0; head < queue.size(); ++head)
            for (int k = e.graph.offset[queue[head]]; k < e.graph.offset[queue[head] + 1]; ++k) {
                const int v = e.graph.target[k];
                if (claim(v, (e.mesh.vertex(v) - e.mesh.vertex(sample)).norm())) queue.push_back(v);
            }
    };
    for (auto _ : state) {
        FarthestPointSampling sampling(e.mesh.vertex_count(), grow);
        sampling.insert(0);
        sampling.cover(0, e.mesh.vertex_count() / 2);
        benchmark::DoNotOptimize(sampling.samples().back());
    }
    state.SetItemsProcessed(state.iterations() * e.mesh.vertex_count());
}

/// Items: queries, one from a little off each vertex.
void closest_point(benchmark::State& state) {
    const Example& e = example(int(state.range(0)));
    const ClosestPoint closest(e.mesh);
    const Points normals = vertex_normals(e.mesh);
    for (auto _ : state)
        for (int v = 0; v < e.mesh.vertex_count(); ++v) {
            const Vec3 query = e.mesh.vertex(v) - .02 * normals.row(v).transpose();
            benchmark::DoNotOptimize(closest(query, normals.row(v).transpose()).squared_distance);
        }
    state.SetItemsProcessed(state.iterations() * e.mesh.vertex_count());
}

/// The same, told the face of the query before.
void closest_point_from_near(benchmark::State& state) {
    const Example& e = example(int(state.range(0)));
    const ClosestPoint closest(e.mesh);
    const Points normals = vertex_normals(e.mesh);
    int near = -1;
    for (auto _ : state)
        for (int v = 0; v < e.mesh.vertex_count(); ++v) {
            const Vec3 query = e.mesh.vertex(v) - .02 * normals.row(v).transpose();
            near = closest(query, normals.row(v).transpose(), near).point.face;
        }
    benchmark::DoNotOptimize(near);
    state.SetItemsProcessed(state.iterations() * e.mesh.vertex_count());
}

/// Items: sides of faces. Each is read three times and written twice: 12 bytes of its face and 16 of its own,
/// 70 in all.
void edges(benchmark::State& state) {
    const Example& e = example(int(state.range(0)));
    for (auto _ : state) benchmark::DoNotOptimize(find_edges(e.mesh).size());
    state.SetItemsProcessed(state.iterations() * 3 * e.mesh.face_count());
    state.SetBytesProcessed(state.iterations() * 3 * e.mesh.face_count() * 70);
}

/// Items: ways between faces that are four edges apart, as the images of an edge's ends are at most.
void strips(benchmark::State& state) {
    const Example& e = example(int(state.range(0)));
    const Edges edges = find_edges(e.mesh);
    const auto four_edges_on = [&](int f) {
        for (int step = 0; step < 4; ++step)
            for (const int side : edges.half_edges[edges.of_half_edge[std::size_t(3 * f + step % 3)]])
                if (side / 3 != f) {
                    f = side / 3;
                    break;
                }
        return f;
    };
    for (auto _ : state)
        for (int f = 0; f < e.mesh.face_count(); ++f)
            benchmark::DoNotOptimize(find_strip(e.mesh, edges, f, four_edges_on(f), 1000).faces.size());
    state.SetItemsProcessed(state.iterations() * e.mesh.face_count());
}

void closest_point_tree(benchmark::State& state) {
    const Example& e = example(int(state.range(0)));
    for (auto _ : state) benchmark::DoNotOptimize(ClosestPoint(e.mesh));
}

BENCHMARK(sampling)->Apply(at_sizes);
BENCHMARK(closest_point)->Apply(at_sizes);
BENCHMARK(closest_point_from_near)->Apply(at_sizes);
BENCHMARK(closest_point_tree)->Apply(at_sizes);
BENCHMARK(edges)->Apply(at_sizes);
BENCHMARK(strips)->Apply(at_sizes);

}  // namespace
}  // namespace varimap::benchmarks
