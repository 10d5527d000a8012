#pragma once

#include <limits>
#include <utility>
#include <vector>

#include "varimap/core/linear_algebra.h"
#include "varimap/mesh/triangle_mesh.h"
#include "varimap/surface/domain.h"

namespace varimap {

/// Graph whose shortest paths approximate geodesics: mesh edges plus, for each interior edge, the diagonal
/// that flipping it would give, with its length in the unfolded pair of triangles. Shortest paths
/// overestimate by a few per cent, which is enough for neighbourhoods; `geodesic.h` measures distances. Of a
/// domain that is no surface: its edges.
struct GeodesicGraph {
    std::vector<int> offset;  ///< vertices + 1
    std::vector<int> target;
    std::vector<double> length;

    GeodesicGraph() = default;
    explicit GeodesicGraph(const TriangleMesh& mesh);
    explicit GeodesicGraph(const Domain& domain);
    int vertex_count() const { return int(offset.size()) - 1; }
};

/// Dijkstra's algorithm from one vertex, stopped early. Holds scratch space for repeated use by one thread.
class GeodesicBall {
  public:
    explicit GeodesicBall(const GeodesicGraph& graph)
        : graph_(graph), distance_(graph.vertex_count(), std::numeric_limits<double>::infinity()) {}

    /// Settles vertices in the order of their distance from `source` while visit(vertex, distance) returns
    /// true.
    template <class Visit>
    void grow(int source, const Visit& visit) {
        grow(std::vector<int>{source}, visit);
    }
    /// The same from the nearest of several sources.
    template <class Visit>
    void grow(const std::vector<int>& sources, const Visit& visit) {
        reset();
        for (const int source : sources) relax(source, 0);
        while (!heap_.empty()) {
            const auto [distance, vertex] = pop();
            if (distance > distance_[vertex]) continue;
            if (!visit(vertex, distance)) break;
            for (int e = graph_.offset[vertex]; e < graph_.offset[vertex + 1]; ++e)
                relax(graph_.target[e], distance + graph_.length[e]);
        }
    }

  private:
    void reset();
    void relax(int vertex, double distance);
    std::pair<double, int> pop();

    const GeodesicGraph& graph_;
    std::vector<double> distance_;
    std::vector<int> touched_;
    std::vector<std::pair<double, int>> heap_;
};

/// sources x vertices: lengths of shortest paths along the graph, infinite where there are none.
RowMatrix distances_from_each(const GeodesicGraph& graph, const std::vector<int>& sources);

}  // namespace varimap
