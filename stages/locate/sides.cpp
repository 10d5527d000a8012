#include "stages/locate/sides.h"

#include "varimap/mesh/topology.h"
#include "varimap/spectral/local_shape.h"

namespace varimap {

PlacedPart place(PointMap images, const Sides& sides, double share, PartPlacing placing) {
    placing.share = share;
    placing.opposed = looks_inward(sides.part) != looks_inward(sides.whole);
    VertexData<bool> pinned(sides.part.mesh.vertex_count());
    for (std::size_t i = 0; i < sides.landmarks_part.size(); ++i) {
        images[std::size_t(sides.landmarks_part[i])] =
            point_at_vertex(sides.whole.mesh, sides.landmarks_whole[i]);
        pinned[sides.landmarks_part[i]] = true;
    }
    return place_part(images, sides.part.mesh, sides.whole.mesh, pinned, placing);
}

}  // namespace varimap
