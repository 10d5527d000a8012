#pragma once

#include "varimap/pair_stage/alternation_params.h"

namespace varimap {

struct RefineParams {
    AlternationOptions alternation;
    IroningOptions ironing;
    double metric_weight = 1;       ///< mu of the mixed metric on all but the last level
    double last_metric_weight = 0;  ///< mu on the last level
    double shape_weight = 0.25;     ///< of add_shape_term beside Eq. (3), as in varimap-diffuse
    int levels = 0;                 ///< stop after this many Euclidean levels; 0: all

    RefineParams() {
        // Chosen by hand on the known pairs, not swept: sliding along the surface in small steps is left to
        // the untangling, which does it faster.
        alternation.tolerance = 3e-3;
        ironing.tolerated_mass = 0.02;
    }

    void describe(ParameterList& list) {
        varimap::describe(list, alternation);
        varimap::describe(list, ironing);
        list.add("metric_weight", metric_weight,
                 "weight of diffusion coordinates beside positions in space (0: space alone)", 0.0, 100.0);
        list.add("last_metric_weight", last_metric_weight, "the same on the last level", 0.0, 100.0);
        list.add("shape_weight", shape_weight,
                 "how strongly places of like bending and shape diameter attract each other (0: not at all)",
                 0.0, 100.0);
        list.add("levels", levels, "stop after this many Euclidean levels (0: all)", 0, 1000);
    }
};

}  // namespace varimap
