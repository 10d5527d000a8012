#include "stages/locate/sides.h"

#include "varimap/mesh/topology.h"

namespace varimap {

Placement pinned_placement(PointMap images, const Sides& sides, double share,
                           const std::vector<ReliefPair>& reliefs, const PlacingOptions& options) {
    VertexData<bool> pinned(sides.part.mesh.vertex_count());
    for (std::size_t i = 0; i < sides.landmarks_part.size(); ++i) {
        images[std::size_t(sides.landmarks_part[i])] =
            point_at_vertex(sides.whole.mesh, sides.landmarks_whole[i]);
        pinned[sides.landmarks_part[i]] = true;
    }
    return placed(images, sides.part.mesh, sides.whole.mesh, pinned, share, reliefs, options);
}

}  // namespace varimap
