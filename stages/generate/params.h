#pragma once

#include "varimap/stage/parameters.h"

namespace varimap {

struct GenerateParams {
    int vertices = 0;
    int members = 0;
    double variation = 1;
    double build = 0;
    double bending = 1;
    double asymmetry = 0;
    double missing = 0;
    double relief = 0.005;

    void describe(ParameterList& list) {
        list.add(
            "vertices", vertices,
            "vertices of each mesh, at least 500 (isometric: about so many); 0: some number from 2000 to "
            "6000, by the seed",
            0, 10'000'000);
        list.add("members", members,
                 "so many members of a family with points that all have, instead of a pair; 0: a pair", 0,
                 999);
        list.add("variation", variation,
                 "how much proportions differ: 0 not at all, 1 as between animals of several species", 0,
                 1.5);
        list.add(
            "build", build,
            "how stout quadrupeds may be, each to a degree of its own: 1 up to a hippopotamus, with short "
            "legs, a barrel of a belly, a large head and a small tail",
            0, 1.2);
        list.add("bending", bending, "how far limbs are bent: 0 not at all, 1 by up to 45 degrees", 0, 2);
        list.add("asymmetry", asymmetry,
                 "how much right limbs differ from left ones: 1 by up to a third in length", 0, 1);
        list.add("missing", missing,
                 "probability that a part a member can do without (a tail, an ear, a finger) is missing", 0,
                 1);
        list.add("relief", relief,
                 "height of bumps, which each member has at places of its own; a leg is 0.15 thick", 0, 0.03);
    }
};

}  // namespace varimap
