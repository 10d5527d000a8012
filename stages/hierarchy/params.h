#pragma once

#include "varimap/spectral/hierarchy.h"
#include "varimap/stage/parameters.h"

namespace varimap {

inline void describe(ParameterList& list, HierarchyOptions& o) {
    list.add("truncation", o.truncation, "epsilon: smaller weights are dropped (Sec. 3.2)", 0.05, 0.95);
    list.add("density", o.density, "tau: every vertex has a weight above it to a sample (Sec. 4.2)", 0.1,
             0.999);
    list.add("growth", o.growth, "diffusion levels end when the next has fewer than this times the samples",
             1.0, 10.0);
    list.add("minimum_neighbours", o.minimum_neighbours, "lower bound on Euclidean neighbourhoods (Sec. 4.5)",
             3, 1000);
    list.add("sampled_share", o.sampled_share, "of the vertices, on the last level but one, at least", 0.0,
             1.0);
    list.add("last_neighbours", o.last_neighbours, "neighbours on the last level, which has every vertex", 3,
             1000);
}

}  // namespace varimap
