#pragma once

#include "stages/locate/sides.h"
#include "varimap/multilevel/pair_context.h"

namespace varimap {

/// One of the two sketches that a part is looked for on.
struct Sketch {
    const SurfaceData& data;
    const GeodesicGraph& graph;

    const TriangleMesh& mesh() const { return data.surface.mesh; }
};

/// Which of a pair is the part. Refers to the pair.
struct Sketches {
    Sketch part, whole;

    Sketches(const PairContext& pair, PartSide which)
        : part(which == PartSide::source ? Sketch{pair.A(), pair.graph_A()}
                                         : Sketch{pair.B(), pair.graph_B()}),
          whole(which == PartSide::source ? Sketch{pair.B(), pair.graph_B()}
                                          : Sketch{pair.A(), pair.graph_A()}) {}
};

}  // namespace varimap
