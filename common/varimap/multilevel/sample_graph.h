#pragma once

#include <mutex>

#include "varimap/geodesics/geodesic_graph.h"
#include "varimap/multilevel/pair_context.h"

namespace varimap {

/// A coarse graph for long shortest paths, with the mesh's vertex numbers: samples of a level are joined to
/// their neighbours and to the samples of adjacent cells by edges as long as the geodesics between them;
/// every other vertex has one edge, to the sample of its cell. Distances from any vertex to the samples
/// exceed those of `graph` by little, and take as long as there are samples, not vertices.
GeodesicGraph sample_graph(const Level& level, const GeodesicGraph& graph);

/// The sample graphs of both surfaces' last diffusion levels with the landmarks, which are samples of every
/// level (no edge leads to a vertex that is none); made when they are first asked for, by whichever thread.
class SampleGraphs {
  public:
    /// Refers to the context.
    explicit SampleGraphs(const PairContext& context) : context_(context) {}
    const GeodesicGraph& A() const;
    const GeodesicGraph& B() const;

  private:
    void make() const;

    const PairContext& context_;
    mutable std::once_flag once_;
    mutable GeodesicGraph A_, B_;
};

}  // namespace varimap
