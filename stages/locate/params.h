#pragma once

#include "stages/locate/sides.h"
#include "varimap/landmarks/vertex_list.h"
#include "varimap/pair_stage/alternation_params.h"
#include "varimap/stage/parameters.h"

namespace varimap {

struct LocateParams {
    PartSide part = PartSide::none;
    PlacingOptions placing;
    LandmarkReading landmark_reading;
    double enough = 0.05;  ///< strain by landmarks, on sketches, from which on no others are tried

    void describe(ParameterList& list) {
        list.add("part", part, "which surface is a part of the other: source or target");
        list.add("placing_steps", placing.steps,
                 "relaxation steps that place the part, in each of two rounds", 0, 10000);
        list.add("robustness", placing.robustness,
                 "excess energy at which a triangle counts half while the part is placed; 0: all count fully",
                 0, 1e6);
        list.add("relief_weight", placing.relief_weight,
                 "weight of like relief against the isometry while the part is placed", 0, 1e3);
        list.add("enough", enough, "a part that is strained less is looked for no longer", 0, 1e6);
        landmark_reading.describe(list);
    }
};

}  // namespace varimap
