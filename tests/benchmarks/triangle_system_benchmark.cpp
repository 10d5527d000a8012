#include <benchmark/benchmark.h>

#include <Eigen/SparseCholesky>

#include "fixtures/shapes.h"
#include "varimap/relaxation/triangle_system.h"

// A step of global relaxation (global_relaxation.h) on a sphere: the system of a symmetric positive definite
// 6 x 6 matrix per triangle is put together, factorised and solved. The pattern is analysed beforehand by
// both.
namespace varimap::benchmarks {
namespace {

using TriangleMatrix = TriangleSystem::TriangleMatrix;

struct SphereSystem {
    int node_count;
    std::vector<std::array<int, 3>> triangles;
    TriangleMatrix matrix;  ///< of every triangle
    Eigen::VectorXd b;

    /// 10 * 4^subdivisions + 2 nodes.
    explicit SphereSystem(int subdivisions) {
        const TriangleMesh sphere = shapes::ellipsoid(subdivisions);
        node_count = sphere.vertex_count();
        for (int f = 0; f < sphere.face_count(); ++f)
            triangles.push_back({sphere.faces(f, 0), sphere.faces(f, 1), sphere.faces(f, 2)});
        std::srand(1);
        const TriangleMatrix root = TriangleMatrix::Random();
        matrix = root * root.transpose() + 0.1 * TriangleMatrix::Identity();
        b = Eigen::VectorXd::Random(2 * node_count);
    }
};

void triangle_system(benchmark::State& state) {
    const SphereSystem sphere(int(state.range(0)));
    TriangleSystem system(sphere.node_count, sphere.triangles);
    for (auto _ : state) {
        system.clear();
        for (int t = 0; t < int(sphere.triangles.size()); ++t) system.add(t, sphere.matrix, 1);
        if (!system.factorize()) state.SkipWithError("singular");
        benchmark::DoNotOptimize(system.solve(sphere.b));
    }
    state.counters["nodes"] = sphere.node_count;
}

/// The lower triangle, from entries in the order of the triangles.
Eigen::SparseMatrix<double> assembled(const SphereSystem& sphere,
                                      std::vector<Eigen::Triplet<double>>& entries) {
    entries.clear();
    for (const auto& t : sphere.triangles)
        for (int row = 0; row < 6; ++row)
            for (int column = 0; column < 6; ++column) {
                const int i = 2 * t[row / 2] + row % 2, j = 2 * t[column / 2] + column % 2;
                if (i >= j) entries.emplace_back(i, j, sphere.matrix(row, column));
            }
    Eigen::SparseMatrix<double> A(2 * sphere.node_count, 2 * sphere.node_count);
    A.setFromTriplets(entries.begin(), entries.end());
    return A;
}

/// `with_assembly`: puts the matrix together in every step, as it has to be; without: what Eigen alone takes.
void simplicial_ldlt(benchmark::State& state, bool with_assembly) {
    const SphereSystem sphere(int(state.range(0)));
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::SparseMatrix<double> A = assembled(sphere, entries);
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver;
    solver.analyzePattern(A);
    for (auto _ : state) {
        if (with_assembly) A = assembled(sphere, entries);
        solver.factorize(A);
        if (solver.info() != Eigen::Success) state.SkipWithError("singular");
        const Eigen::VectorXd x = solver.solve(sphere.b);
        benchmark::DoNotOptimize(x.data());
    }
    state.counters["nodes"] = sphere.node_count;
}

BENCHMARK(triangle_system)->Arg(5)->Arg(6)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(simplicial_ldlt, factorise_and_solve, false)->Arg(5)->Arg(6)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(simplicial_ldlt, with_assembly, true)->Arg(5)->Arg(6)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace varimap::benchmarks
