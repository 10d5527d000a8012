#include <benchmark/benchmark.h>

#include <numeric>

#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"
#include "varimap/map_repair/normal_agreement.h"
#include "varimap/mesh/coarsening.h"
#include "varimap/relaxation/fold_removal.h"
#include "varimap/relaxation/local_relaxation.h"

// What relaxing on the input and coarsening spend their time with, at 10 * 4^n + 2 vertices. The floor beside
// each is what it has to read and compute: bytes are those of the vertex's star and of the target beneath,
// each read once; operations are additions and multiplications of the formulas in the headers.
namespace varimap::benchmarks {
namespace {

TriangleMesh egg(int subdivisions) {
    return shapes::ellipsoid(subdivisions, {1, 1.2, 1.6});
}

/// An egg turned onto itself.
struct Turned {
    TriangleMesh mesh;
    PointMap images;
    explicit Turned(int subdivisions) : mesh(egg(subdivisions)), images(shapes::turned_identity(mesh, .3)) {}
};

/// Visits of vertices in random order. A star of 6 faces: 6 rest triangles of 32 bytes, 7 images and normals
/// of 48, and about 3 faces of the target with corners, normals and frames of 200, so 1.1 KB; quadratic and
/// one trial are 6 x 150 operations, a walk 100.
void relaxation_sweep(benchmark::State& state) {
    const Turned turned(int(state.range(0)));
    SlidingMap map(turned.images, turned.mesh, turned.mesh);
    std::vector<int> vertices(std::size_t(turned.mesh.vertex_count()));
    std::iota(vertices.begin(), vertices.end(), 0);
    LocalRelaxation relax(map, 99);
    for (auto _ : state) relax.sweep(vertices, {1, .1});
    state.SetItemsProcessed(state.iterations() * turned.mesh.vertex_count());
    state.SetBytesProcessed(state.iterations() * turned.mesh.vertex_count() * 1100);
    state.counters["operations"] = benchmark::Counter(double(turned.mesh.vertex_count()) * 1000,
                                                      benchmark::Counter::kIsIterationInvariantRate);
}

/// Every hundredth vertex's image exchanged with a neighbour's. Items: folded faces.
void fold_removal(benchmark::State& state) {
    Turned turned(int(state.range(0)));
    for (int f = 0; f < turned.mesh.face_count(); f += 200)
        std::swap(turned.images[std::size_t(turned.mesh.faces(f, 0))],
                  turned.images[std::size_t(turned.mesh.faces(f, 1))]);
    const VertexData<bool> none(turned.mesh.vertex_count());
    int folds = 0, sweeps = 0;
    for (auto _ : state) {
        state.PauseTiming();
        SlidingMap map(turned.images, turned.mesh, turned.mesh);
        folds = 0;
        for (int f = 0; f < turned.mesh.face_count(); ++f)
            folds += map.image_triangle(f).D <= FoldRemoval::flat_limit;
        state.ResumeTiming();
        sweeps = FoldRemoval{}(map, none);
    }
    state.SetItemsProcessed(state.iterations() * folds);
    state.counters["sweeps_per_fold"] = double(sweeps) / folds;
}

/// Items: faces. At best none asks for a closest point: 3 images and 6 to 18 face normals are read, .9 KB.
void normal_check(benchmark::State& state) {
    const Turned turned(int(state.range(0)));
    SlidingMap map(turned.images, turned.mesh, turned.mesh);
    for (auto _ : state) {
        state.PauseTiming();
        AlongTarget along_target(map);
        NormalAgreement agreement(map, along_target);  // it remembers
        state.ResumeTiming();
        benchmark::DoNotOptimize(agreement.disagreeing_faces().size());
    }
    state.SetItemsProcessed(state.iterations() * turned.mesh.face_count());
    state.SetBytesProcessed(state.iterations() * turned.mesh.face_count() * 900);
}

/// Items: collapses. Each reads and writes 7 quadrics of 112 bytes and the half-edges of 6 faces, measures 14
/// costs and compares 42: 2.5 KB and about 800 operations.
void collapse(benchmark::State& state) {
    const TriangleMesh mesh = egg(int(state.range(0)));
    const int left = mesh.vertex_count() / 10;
    for (auto _ : state) benchmark::DoNotOptimize(coarsen(mesh, left).vertex.size());
    state.SetItemsProcessed(state.iterations() * (mesh.vertex_count() - left));
    state.SetBytesProcessed(state.iterations() * (mesh.vertex_count() - left) * 2500);
}

void at_subdivisions(benchmark::internal::Benchmark* benchmark) {
    benchmark->Arg(5)->Arg(6)->Unit(benchmark::kMillisecond);
}
BENCHMARK(relaxation_sweep)->Apply(at_subdivisions);
BENCHMARK(fold_removal)->Apply(at_subdivisions);
BENCHMARK(normal_check)->Apply(at_subdivisions);
BENCHMARK(collapse)->Apply(at_subdivisions);

}  // namespace
}  // namespace varimap::benchmarks
