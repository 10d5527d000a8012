#pragma once

#include "varimap/stage/parameters.h"

namespace varimap {

struct GromovParams {
    double regularisation = 1e-3;
    int iterations = 300;
    double tolerance = 1e-6;

    void describe(ParameterList& list) {
        list.add("regularisation", regularisation, "gamma / square of the larger diameter", 1e-6, 1.0);
        list.add("iterations", iterations, "transport problems solved at most", 1, 100000);
        list.add("tolerance", tolerance, "ends when the energy changes by less than this share", 0.0, 1.0);
    }
};

}  // namespace varimap
