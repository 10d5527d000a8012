#pragma once

#include "varimap/mesh_repair/mesh_repair.h"
#include "varimap/stage/parameters.h"

namespace varimap {

struct PreprocessParams {
    double target_edge_length = 0;
    int max_vertices = 2'000'000;
    bool mirror = false;
    RepairOptions repair;
    std::string fill_holes = "none";
    std::string cut_handles = "auto";

    void describe(ParameterList& list) {
        list.add("target_edge_length", target_edge_length,
                 "longest edge after bisection, in units of sqrt(area); 0: twice the mean edge of an even "
                 "triangulation with the mesh's vertices, or with 2500 where it has fewer",
                 0, 10);
        list.add("max_vertices", max_vertices, "refuse to bisect beyond this many vertices", 3, 100'000'000);
        list.add("mirror", mirror,
                 "reverse the surface's orientation, to map it onto one of opposite handedness");
        repair.describe(list);
        list.add("fill_holes", fill_holes,
                 "boundary loops of at most so many edges are closed; or all, or none", {});
        list.add("cut_handles", cut_handles,
                 "handles and tunnels that a closed path of at most this length goes around, in units of "
                 "sqrt(area), are cut and closed; or none; or auto: 0.05 where there are more than 20",
                 {});
    }
};

}  // namespace varimap
