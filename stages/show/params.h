#pragma once

#include "varimap/stage/parameters.h"

namespace varimap {

struct ShowParams {
    int point = 0;
    double time = .02;

    void describe(ParameterList& list) {
        list.add("point", point, "whose weights or whose row of the plan is shown, from 0", 0, 2147483647);
        list.add("time", time, "weights: diffusion time, as a share of the coarsest", 1e-9, 1.0);
    }
};

}  // namespace varimap
