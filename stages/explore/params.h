#pragma once

#include "stages/explore/explore.h"
#include "varimap/pair_stage/alternation_params.h"

namespace varimap {

struct ExploreParams {
    AlternationOptions alternation;
    IroningOptions ironing;
    ExplorationOptions exploration;
    LandmarkSpace landmark_space = LandmarkSpace::stated;
    double landmark_weight = 1;  ///< W of pull_landmarks (cost.h); 1: pinned

    ExploreParams() { ironing.maximum_rounds = 0; }

    void describe(ParameterList& list) {
        describe_exact(list, alternation);
        varimap::describe(list, ironing);
        list.add("random_starts", exploration.random_starts, "random starts at each of three coarse levels",
                 0, 10000);
        list.add("seed", exploration.seed, "of the random starts", 0, 1000000000);
        list.add("candidates", exploration.candidates, "maps that are kept to the last level", 1, 100);
        list.add("distinct", exploration.distinct,
                 "maps closer than this are duplicates: mean squared distance / variance", 0.0, 2.0);
        list.add("euclidean_exponent", exploration.euclidean_exponent,
                 "of the energy on the first Euclidean level, in the ranking", 0.0, 10.0);
        list.add("bending_weight", exploration.bending_weight, "of the agreement of bending, in the ranking",
                 0.0, 10.0);
        varimap::describe(list, landmark_space);
        list.add("landmark_weight", landmark_weight,
                 "how firmly landmarks hold (1: pinned; less: the map may disagree)", 1e-3, 1.0);
    }
};

}  // namespace varimap
