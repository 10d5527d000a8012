#pragma once

#include <vector>

#include "varimap/mesh/triangle_mesh.h"
#include "varimap/relaxation/mirrored_parts.h"
#include "varimap/relaxation/part_replacement.h"

namespace varimap {

struct UntanglingOptions {
    bool enabled = true;
    int global_steps =
        10;  ///< of relaxation over the whole map, each of two times; fewer from 20'000 vertices on
    double area_weight = 1;  ///< w of the fold energy: areas against angles
    double robustness =
        0.3;  ///< excess energy at which a face counts half in global steps; 0: all count fully
    double relief_weight = 2;  ///< of features against the fold energy in global steps (relief_agreement.h)
    /// Of each direction's attraction to the other's inverse (soft_constraints.h) in the last global steps.
    double inverse_weight = 1000;
    int fold_sweeps = 120;  ///< sweeps per patch size that remove folds
    MirrorGate gate;
    PartReplacementOptions parts;
    bool replace_parts = true;
    bool align_normals = true;
};

/// What untangling did; counts and areas by the test of quality.h (n . m <= 0, collapsed included).
struct UntanglingReport {
    int flipped_before = 0, flipped_after = 0;
    double flipped_area_percent_before = 0, flipped_area_percent_after = 0;
    int global_steps = 0;                     ///< that lowered the energy
    int sweeps = 0;                           ///< of fold removal
    int parts_tried = 0, parts_replaced = 0;  ///< see part_replacement.h
    double replaced_area_percent = 0;         ///< share of the source's area, counted as often as replaced
    int mirrored_parts = 0;                   ///< left as they are
    double gated_area_percent = 0;            ///< their share of the source's area
    int disagreeing_before = 0,
        disagreeing_after = 0;  ///< faces that cut through a feature (normal_agreement.h)
};

/// Slides the images of the source's vertices on the target until no triangle of the cross-remeshed source is
/// reversed or collapsed, the map is as near to an isometry as it gets (fold_energy.h), and features meet
/// (relief_agreement.h):
///  1. global relaxation, robust against parts that cannot be isometric, and removal of folds in patches;
///  2. strained parts, which are mirrored, twisted or crumpled, mapped anew (part_replacement.h);
///  3. the first step once more, with less regularisation;
///  4. faces that cut through thin features turned the target's way (normal_agreement.h).
/// Vertices with pinned[v] (landmarks) stay. Parts that are mirrored in the end stay too: a map that is made
/// flip-free there would be wrong all the same. A map that would not gain is left as it was. Deterministic
/// and serial. Vertices without an image keep none.
UntanglingReport untangle(PointMap& map, const TriangleMesh& source, const TriangleMesh& target,
                          const std::vector<char>& pinned, const UntanglingOptions& options);

/// Both directions, in parallel; in global steps each is drawn to the other's inverse, and after the second
/// step each tries the other's inverse, for itself and for its strained parts.
struct MapPair {
    PointMap A_to_B, B_to_A;
};
struct PinnedPair {
    std::vector<char> A, B;
    PointPairs points =
        {};  ///< of both meshes, drawn onto each other (soft_constraints.h) rather than pinned
};
struct UntanglingReports {
    UntanglingReport A_to_B, B_to_A;
};
UntanglingReports untangle(MapPair& maps, const TriangleMesh& A, const TriangleMesh& B,
                           const PinnedPair& pinned, const UntanglingOptions& options);

}  // namespace varimap
