#pragma once

#include <string>

#include "varimap/pair_stage/alternation_params.h"

namespace varimap {

struct DiffuseParams {
    AlternationOptions alternation;
    IroningOptions ironing;
    std::string start =
        "zero";  ///< first centres: zero, or those of the Wasserstein-2 plan (aligned surfaces)
    double wasserstein_weight =
        0;                         ///< share of the Wasserstein-2 cost added to Eq. (3), for aligned surfaces
    double feature_weight = 0.25;  ///< of the features of FeatureTerm beside Eq. (3)
    int candidate = 1;             ///< which of the candidates of varimap-explore is continued
    double landmark_weight = 1;    ///< W of pull_landmarks (cost.h); 1: pinned
    bool check_landmarks = true;   ///< compares the map with one that lacks each landmark in turn
    int levels = 0;                ///< stop after this many diffusion levels; 0: all

    void describe(ParameterList& list) {
        varimap::describe(list, alternation);
        varimap::describe(list, ironing);
        list.add("start", start, "first centres: zero, or wasserstein for rigidly aligned surfaces (Sec. 5)",
                 {"zero", "wasserstein"});
        list.add("wasserstein_weight", wasserstein_weight,
                 "weight of the Wasserstein-2 cost beside Eq. (3), relative; for aligned surfaces (Sec. 2.3)",
                 0.0, 100.0);
        list.add("feature_weight", feature_weight,
                 "how strongly places of like bending and thickness attract each other (0: not at all)", 0.0,
                 100.0);
        list.add("candidate", candidate,
                 "which of the maps that varimap-explore found is continued (1: the best)", 1, 100);
        list.add("landmark_weight", landmark_weight,
                 "how firmly landmarks hold (1: pinned; less: the map may disagree)", 1e-3, 1.0);
        list.add("check_landmarks", check_landmarks, "names landmarks that the others contradict");
        list.add("levels", levels, "stop after this many diffusion levels (0: all)", 0, 1000);
    }
};

}  // namespace varimap
