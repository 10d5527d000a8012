#pragma once

#include "varimap/stage/parameters.h"

namespace varimap {

struct CoarsenParams {
    int vertices = 6000;

    void describe(ParameterList& list) {
        list.add("vertices", vertices,
                 "a mesh with more vertices is coarsened to so many, on which the map is solved for", 100,
                 100'000'000);
    }
};

}  // namespace varimap
