#pragma once

#include <vector>

#include "varimap/mesh/disc.h"
#include "varimap/relaxation/fold_removal.h"
#include "varimap/sliding/sliding_map.h"

namespace varimap {

/// A disc of the source, and a disc of the target that holds what the images of its rim enclose, laid flat:
/// in the plane a map with a simple polygon for its rim and no reversed face is one to one (Lipman 2014), and
/// so is the map that it stands for.
class ChartedPart {
  public:
    /// Copies what it needs of the map. `part`: of its source, a disc with that boundary (disc_boundary);
    /// `goal`: faces of its target, ascending.
    ChartedPart(const SlidingMap& map, SubMesh part, std::vector<int> rim, std::vector<int> goal);

    bool are_discs() const { return corners_.rows() > 0; }
    /// Whether the images of the rim, joined by segments of the chart, touch themselves nowhere and go round
    /// counter-clockwise.
    bool has_simple_rim() const;

    const std::vector<int>& vertices() const { return part_.vertex; }  ///< of the source, ascending
    const std::vector<int>& faces() const { return part_.face; }
    /// Those that do not lie on the rim and are not fixed.
    std::vector<int> free_vertices(const VertexData<bool>& fixed) const;

    /// Maps the inside anew, without a reversed face in the chart: images of `vertices()`; none if that was
    /// not achieved. Vertices with fixed[v] stay, as does the rim.
    PointMap unfolded(const SlidingMap& map, const VertexData<bool>& fixed) const;

  private:
    PointMap on_chart(const Points& positions) const;
    /// Images on the whole once these, in the chart, are unfolded towards the shapes of `rest`; none where
    /// faces stay reversed.
    PointMap unfolded_from(const PointMap& images, const TriangleMesh& rest, const VertexData<bool>& held,
                           const FoldRemoval& remove_folds) const;
    VertexData<bool> rim_vertices() const;  ///< of part_.mesh
    /// None where the walks in the chart made no sense.
    PointMap on_whole(const SlidingMap& in_chart) const;

    SubMesh part_, goal_;
    std::vector<int> rim_;  ///< of part_.mesh
    TriangleMesh chart_;    ///< of goal_.mesh; empty if that is no disc
    Points corners_;        ///< images of the rim in the chart; none if one lies elsewhere
};

}  // namespace varimap
