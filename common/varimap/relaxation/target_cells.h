#pragma once

#include <vector>

#include "varimap/mesh/geodesic_graph.h"
#include "varimap/relaxation/sliding_map.h"

namespace varimap {

/// The target in cells a few source edges wide: tells at little cost which parts of it a map enters. (What
/// images of triangles cover is costly to know, and image triangles cut through the root of a limb that no
/// vertex enters.)
class TargetCells {
  public:
    /// Cells of up to `radius` around vertices of the target.
    TargetCells(const SlidingMap& map, const GeodesicGraph& target_graph, double radius);

    /// Per cell, whether an image lies in it.
    std::vector<char> occupied(const SlidingMap& map) const;
    /// Area of the cells that are occupied before, but not after.
    double lost_area(const std::vector<char>& before, const std::vector<char>& after) const;

  private:
    VertexData<int> cell_of_vertex_;
    std::vector<double> area_;
};

}  // namespace varimap
