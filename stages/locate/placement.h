#pragma once

#include <array>
#include <limits>
#include <vector>

#include "varimap/core/indexed.h"
#include "varimap/mesh/triangle_mesh.h"
#include "varimap/relaxation/relief_agreement.h"

namespace varimap {

struct PlacingOptions {
    int steps = 200;  ///< of relaxation in each of two rounds, at most
    double robustness = 1;
    double relief_weight = 1;
};

/// Times the option's relief weight, each for a placement from the same images: with much of it the part
/// follows its like where it can, with little it comes there from afar.
constexpr std::array<double, 2> relief_factors{0.5, 1.5};

/// Where a part lies on its whole.
struct Placement {
    PointMap images;  ///< of the vertices of the part's mesh
    /// The mean of the fold energy over an isometry's, per area, 0 at best; infinite where vertices have no
    /// image.
    double strain = std::numeric_limits<double>::infinity();
    double relief = 0;  ///< how the reliefs correlate, 1 at best; 0 if they have no weight
};

/// Slides the images of a part's vertices on the whole until the map is as near to an isometry as it gets
/// (fold_energy.h), and like relief meets (relief_agreement.h). Nothing holds the part's rim: it comes to lie
/// where the inside, and landmarks, have it. Vertices with pinned[v] stay. Both meshes of unit area; `share`:
/// of the whole's area, which the part has, so that lengths of the part are those of the whole times its
/// root. `reliefs`: of both meshes (relief_pairs), in units of either, as if both were alike large.
/// Deterministic; serial.
Placement placed(const PointMap& images, const TriangleMesh& part, const TriangleMesh& whole,
                 const VertexData<bool>& pinned, double share, const std::vector<ReliefPair>& reliefs,
                 const PlacingOptions& options);

}  // namespace varimap
