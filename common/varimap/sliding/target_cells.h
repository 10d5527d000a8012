#pragma once

#include <vector>

#include "varimap/geodesics/geodesic_graph.h"
#include "varimap/sliding/sliding_map.h"

namespace varimap {

/// The target in cells a few source edges wide: tells at little cost which parts of it a map enters. (What
/// images of triangles cover is costly to know, and image triangles cut through the root of a limb that no
/// vertex enters.)
class TargetCells {
  public:
    /// Cells of up to `radius` around vertices of the target. Keeps a reference to that.
    TargetCells(const SlidingMap& map, const GeodesicGraph& target_graph, double radius);

    /// Per cell, whether one of these points of the target lies in it.
    std::vector<char> occupied(const PointMap& points) const;
    /// Whether a point lies in one of the marked cells.
    bool lies_in(const SurfacePoint& point, const std::vector<char>& marked) const;
    double area(const std::vector<char>& marked) const;
    /// Area of the cells that are occupied before, but not after.
    double lost_area(const std::vector<char>& before, const std::vector<char>& after) const;

  private:
    const Faces& faces_;  ///< of the target
    VertexData<int> cell_of_vertex_;
    std::vector<double> area_;
};

/// Of cells: two edges of the source.
double usual_cell_radius(const SlidingMap& map);

}  // namespace varimap
