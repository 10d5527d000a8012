#pragma once

#include <vector>

#include "common/mapping/mirrored_parts.h"
#include "common/mesh/triangle_mesh.h"

namespace varimap {

struct UntanglingOptions {
    bool enabled = true;
    int global_steps =
        3;  ///< of relaxation over the whole map, each of two times; fewer from 20'000 vertices on
    double area_weight = 1;  ///< w of the fold energy: areas against angles
    double robustness =
        0.3;                ///< excess energy at which a face counts half in global steps; 0: all count fully
    int fold_sweeps = 120;  ///< sweeps per patch size that remove folds
    MirrorGate gate;
};

/// What untangling did; counts and areas by the test of quality.h (n . m <= 0, collapsed included).
struct UntanglingReport {
    int flipped_before = 0, flipped_after = 0;
    double flipped_area_percent_before = 0, flipped_area_percent_after = 0;
    int global_steps = 0;           ///< that lowered the energy
    int sweeps = 0;                 ///< of fold removal
    int mirrored_parts = 0;         ///< left as they are
    double gated_area_percent = 0;  ///< their share of the source's area
};

/// Slides the images of the source's vertices on the target until no triangle of the cross-remeshed source is
/// reversed or collapsed, and the map is as near to an isometry as it gets (fold_energy.h): global
/// relaxation, robust against parts that cannot be isometric; removal of the remaining folds in patches;
/// both once more. Vertices with pinned[v] (landmarks) and mirrored parts stay, the latter because a map that
/// is made flip-free there would be wrong all the same. A map that would not gain is left as it was.
/// Deterministic and serial. Vertices without an image keep none.
UntanglingReport untangle(PointMap& map, const TriangleMesh& source, const TriangleMesh& target,
                          const std::vector<char>& pinned, const UntanglingOptions& options);

}  // namespace varimap
