#pragma once

#include <limits>

#include "varimap/parts/mirrored_parts.h"
#include "varimap/parts/part_replacement.h"
#include "varimap/untangling/rounds.h"

namespace varimap {

// Where the constants of this room, and of those it builds on from `sliding`, come from. "Swept" over a
// range: its ends were tried, one constant at a time, on a pair of cats (TOSCA cat0 and cat1, 5'000
// vertices), and the maps were as good as before: no flipped triangle, at most 10 that verification.h finds
// reversed, mean round trips of 0.00145 to 0.00170, coverage of 0.9949 to 0.9974. Rounding alone (another
// level of optimisation) moves that pair by 0.0010 in coverage, from 0.00154 to 0.00157 in the round trip,
// and which of its parts are mapped anew. Constants that name neither a range nor a source were chosen by
// hand on the known pairs and not swept.

/// What untangling does, and how much of it.
struct UntanglingOptions {
    bool enabled = true;
    /// Of relaxation over the whole map, each of two times; fewer from 20'000 vertices on.
    int global_steps = 10;
    double area_weight = 1;  ///< w of the fold energy: areas against angles
    /// Excess energy at which a face counts half in global steps; 0: all count fully.
    double robustness = 0.3;
    double relief_weight = 2;  ///< of relief against the fold energy in global steps (relief_agreement.h)
    /// It counts less, or not at all, where the reliefs do not agree on the map that is given.
    bool weigh_relief = true;
    /// The surfaces are of opposite handedness: faces of one of them look inward.
    bool opposed = false;
    /// Of each direction's attraction to the other's inverse (soft_constraints.h) in the last global steps.
    double inverse_weight = 1000;
    /// Of boundaries that correspond (boundary_agreement.h) in global steps.
    double boundary_weight = 30;
    /// Over the whole map, before folds are removed: for a map that was relaxed at a lower resolution. With
    /// any, there is one round.
    int local_sweeps = 0;
    /// Of relaxation in the end, with more weight of the other direction's inverse, and the area bound.
    int settling_steps = 15;
    double area_bound = 0;                ///< that areas around vertices are to keep (area_bound.h); 0: none
    int fold_sweeps = usual_fold_sweeps;  ///< sweeps per patch size that remove folds
    /// Visits per vertex that each removal of folds may take, if fewer than otherwise.
    double most_fold_visits = std::numeric_limits<double>::infinity();
    MirrorGate gate;
    PartReplacementOptions parts;
    bool replace_parts = true;
    bool align_normals = true;
    /// Maps what is left of the faults anew once more at the end, where they are few.
    bool repair_again = true;
    /// Moves single vertices at the end (star_kernels.h).
    bool centre_stars = true;
    /// Brings areas back into the bound at the very end (bound_repair.h), if maps settle in it and are
    /// repaired.
    bool restore_bound = true;
};

}  // namespace varimap
