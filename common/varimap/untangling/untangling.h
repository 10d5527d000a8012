#pragma once

#include "varimap/core/indexed.h"
#include "varimap/mesh/triangle_mesh.h"
#include "varimap/results/map_pair.h"
#include "varimap/results/untangling_report.h"
#include "varimap/untangling/untangling_options.h"

namespace varimap {

/// Landmarks of both meshes.
struct PinnedPair {
    VertexData<bool> A, B;  ///< vertices that stay where they are
    PointPairs points =
        {};  ///< of both meshes, drawn onto each other (soft_constraints.h) rather than pinned
};

/// Slides the images of both meshes' vertices on the other mesh until no image triangle is reversed or
/// collapsed, the maps are as near to isometries as they get (fold_energy.h), inverse to each other
/// (soft_constraints.h), and like relief meets (relief_agreement.h):
///  1. global relaxation, robust against parts that cannot be isometric, and removal of folds in patches;
///  2. strained parts, which are mirrored, twisted or crumpled, mapped anew (part_replacement.h), as their
///     surroundings or the other direction's inverse have it;
///  3. the first step once more, with less regularisation;
///  4. the maps settled into each other's inverse and the area bound (area_bound.h);
///  5. what is reversed along the target mapped anew in charts (chart_repair.h), and faces that cut through
///     thin features turned the target's way (normal_agreement.h); where few faults are left, once more, and
///     where the other direction has fewer, by its inverse (fault_repair.h);
///  6. areas that this has taken out of the bound brought back (bound_repair.h).
/// Parts that are mirrored in the end stay so: a map that is made flip-free there would be wrong all the
/// same. A map that would not gain is left as it was. Vertices without an image keep none. Deterministic,
/// though the two directions run side by side, and repair looks at several faces at a time.
UntanglingReports untangle(MapPair& maps, const TriangleMesh& A, const TriangleMesh& B,
                           const PinnedPair& pinned, const UntanglingOptions& options);

}  // namespace varimap
