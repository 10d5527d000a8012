#pragma once

#include <benchmark/benchmark.h>

#include "varimap/geodesics/geodesic_graph.h"
#include "varimap/mesh/triangle_mesh.h"
#include "varimap/multilevel/level_transfer.h"

namespace varimap::benchmarks {

/// The problem of the last level: a tube of about `vertices` vertices mapped onto itself, every vertex a
/// sample.
struct Example {
    LevelPair pair;
    GeodesicGraph graph;
    TriangleMesh mesh;
    Centres centres;  ///< those of the identity
    Support support;  ///< neighbours of the identity
    Eigen::VectorXd cost;
};

/// Built once for each size.
const Example& example(int vertices);

/// Of examples of 5,000 and 20,000 vertices, in wall-clock milliseconds.
void at_sizes(benchmark::internal::Benchmark* benchmark);

}  // namespace varimap::benchmarks
