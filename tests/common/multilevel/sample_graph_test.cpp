#include "varimap/multilevel/sample_graph.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "fixtures/known_pair.h"

namespace varimap {
namespace {

/// Where landmarks were none of the graph's vertices, nothing led to them, and distances were left undefined.
TEST(SampleGraphs, LeadToLandmarks) {
    const shapes::KnownPair figures = shapes::figure_pair(.6, false);
    const Level& last = figures.A.hierarchy.last_diffusion_level();
    int vertex = 0;
    while (last.samples[std::size_t(last.cell[std::size_t(vertex)])] == vertex) ++vertex;
    const PairContext context(figures.A, figures.A, {{MeshVertex{vertex}, MeshVertex{vertex}}});
    const SampleGraphs graphs(context);
    for (const GeodesicGraph& graph : {graphs.A(), graphs.B()}) {
        bool found = false;
        GeodesicBall(graph).grow(last.samples[0], [&](int v, double) { return !(found = v == vertex); });
        EXPECT_TRUE(found);
    }
}

}  // namespace
}  // namespace varimap
