#pragma once

#include "varimap/stage/parameters.h"

namespace varimap {

struct CoarsenParams {
    int vertices = 6000;
    int thin_vertices = 24'000;
    double most_lost = 0.03;  ///< people and animals lose .3%, skulls of thin bone 9%

    void describe(ParameterList& list) {
        list.add("vertices", vertices,
                 "a mesh with more vertices is coarsened to so many, on which the map is solved for", 100,
                 100'000'000);
        list.add("thin_vertices", thin_vertices,
                 "a mesh that loses too much area, because it has thin walls, keeps up to so many", 0,
                 100'000'000);
        list.add("most_lost", most_lost, "share of the area that is not too much; 1: anything", 0.0, 1.0);
    }
};

}  // namespace varimap
