#pragma once

#include "varimap/core/indexed.h"
#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

struct PartPlacing {
    double share = 1;  ///< of the whole's area, which the part has
    /// The surfaces are of opposite handedness: faces of one of them look inward.
    bool opposed = false;
    int steps = 200;  ///< of relaxation in each of two rounds, at most
    double robustness = 1;
    double relief_weight = 0.5;
};

struct PlacedPart {
    PointMap images;
    double strain = 0;  ///< the mean of the fold energy over an isometry's, per area: 0 at best
};

/// Slides the images of a part's vertices on the whole until the map is as near to an isometry as it gets
/// (fold_energy.h), and like relief meets (relief_agreement.h). Nothing holds the part's rim: it comes to lie
/// where the inside, and landmarks, have it. Vertices with pinned[v] stay. Both meshes of unit area: lengths
/// of the part are those of the whole times the root of the share. Deterministic; serial.
PlacedPart place_part(const PointMap& images, const TriangleMesh& part, const TriangleMesh& whole,
                      const VertexData<bool>& pinned, const PartPlacing& placing);

}  // namespace varimap
