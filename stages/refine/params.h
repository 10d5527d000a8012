#pragma once

#include <array>

#include "varimap/pair_stage/alternation_params.h"

namespace varimap {

/// Where the first level that is solved begins.
enum class RefineStart : int {
    diffusion = 0,  ///< with the plan of varimap-diffuse
    wasserstein =
        1,  ///< with the Wasserstein-2 plan, on all points at once: Alg. 1 alone, as in Fig. 2 and 3
};
template <>
struct EnumNames<RefineStart> {
    static constexpr std::array names{"diffusion", "wasserstein"};
};

struct RefineParams {
    AlternationOptions alternation;
    IroningOptions ironing;
    double metric_weight = 1;       ///< mu of the mixed metric on all but the last level
    double last_metric_weight = 0;  ///< mu on the last level
    DescriptorWeights descriptors;
    RefineStart start = RefineStart::diffusion;
    int levels = 0;  ///< stop after this many Euclidean levels; 0: all

    RefineParams() {
        // Chosen by hand on the known pairs, not swept: sliding along the surface in small steps is left to
        // the untangling, which does it faster.
        alternation.tolerance = 3e-3;
        // What is scattered is left to it, too, and was hardly ever ironed out: 3 % before, 3 % after. With
        // .02 refining takes half as long again to twice as long; errors of 36 pairs and of 31 others, on
        // which nothing was chosen, are .99 and 1.006 times as large, less than by chance.
        ironing.tolerated_mass = 0.1;
    }

    void describe(ParameterList& list) {
        varimap::describe(list, alternation);
        varimap::describe(list, ironing);
        list.add("metric_weight", metric_weight,
                 "weight of diffusion coordinates beside positions in space (0: space alone)", 0.0, 100.0);
        list.add("last_metric_weight", last_metric_weight, "the same on the last level", 0.0, 100.0);
        varimap::describe(list, descriptors);
        list.add("start", start,
                 "diffusion: the plan of varimap-diffuse; wasserstein: only levels with all points, from the "
                 "Wasserstein-2 plan of aligned, small domains (Fig. 2)");
        list.add("levels", levels, "stop after this many Euclidean levels (0: all)", 0, 1000);
    }
};

}  // namespace varimap
