#pragma once

#include <limits>

#include "varimap/core/indexed.h"
#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

struct PlacingOptions {
    int steps = 200;  ///< of relaxation in each of two rounds, at most
    double robustness = 1;
    double relief_weight = 1;
};

/// Where a part lies on its whole.
struct Placement {
    PointMap images;  ///< of the vertices of the part's mesh
    /// The mean of the fold energy over an isometry's, per area, 0 at best; infinite where vertices have no
    /// image.
    double strain = std::numeric_limits<double>::infinity();
};

/// Slides the images of a part's vertices on the whole until the map is as near to an isometry as it gets
/// (fold_energy.h), and like relief meets (relief_agreement.h). Nothing holds the part's rim: it comes to lie
/// where the inside, and landmarks, have it. Vertices with pinned[v] stay. Both meshes of unit area; `share`:
/// of the whole's area, which the part has, so that lengths of the part are those of the whole times its
/// root. Reliefs are measured in units of either mesh, as if both were alike large. `opposed`: the faces of
/// one mesh alone look inward. Deterministic; serial.
Placement placed(const PointMap& images, const TriangleMesh& part, const TriangleMesh& whole,
                 const VertexData<bool>& pinned, double share, bool opposed, const PlacingOptions& options);

}  // namespace varimap
