#pragma once

#include <algorithm>

#include "stages/explore/exploration.h"
#include "stages/explore/finishing.h"
#include "varimap/landmarks/vertex_list.h"
#include "varimap/pair_stage/alternation_params.h"

namespace varimap {

struct ExploreParams {
    AlternationOptions alternation;  ///< its area bound is that of the maps that are finished
    IroningOptions ironing;
    ExplorationOptions exploration;
    FinishingOptions finishing;
    bool self_maps = false;
    bool only_if_needed = false;  ///< with landmarks: unless the map that they lead to is a good one
    int few_landmarks = varimap::few_landmarks;  ///< with more, they are taken to decide
    int composed = 2;                            ///< maps that self-maps are composed with
    LandmarkReading landmark_reading;
    double landmark_weight = 1;  ///< W of pull_landmarks (cost.h); 1: pinned

    ExploreParams() { ironing.maximum_rounds = 0; }

    /// As finely as telling maps apart takes. Chosen by hand on half of the known pairs: most energies move
    /// by a hundredth.
    FinishingOptions quick_finishing() const {
        FinishingOptions quick = finishing;
        quick.alternation = for_comparison(alternation, alternation.area_bound);
        quick.alternation.tolerance = std::max(quick.alternation.tolerance, 1e-2);
        quick.alternation.sinkhorn_iterations = std::min(quick.alternation.sinkhorn_iterations, 20);
        return quick;
    }

    void describe(ParameterList& list) {
        describe_exact(list, alternation);
        varimap::describe(list, ironing);
        list.add("random_starts", exploration.random_starts, "random starts at each of three coarse levels",
                 0, 10000);
        list.add("tip_starts", exploration.tip_starts, "starts from matched ends of limbs", 0, 10000);
        list.add("seed", exploration.seed, "of the random starts", 0, 1000000000);
        list.add("candidates", exploration.candidates, "maps that are kept to the last level", 1, 100);
        list.add("distinct", exploration.distinct,
                 "maps closer than this are duplicates: mean squared distance / variance", 0.0, 2.0);
        list.add("area_bound", exploration.area_bound, "of the maps that are explored, as in varimap-diffuse",
                 1.0, 1e6);
        list.add("onto_itself", self_maps, "looks for maps of one surface, given twice, onto itself");
        list.add("only_if_needed", only_if_needed,
                 "with landmarks: looks for maps only where that which they lead to is doubtful; where it is "
                 "not, writes that alone");
        list.add("few_landmarks", few_landmarks, "with more landmarks than these, nothing is needed", 0,
                 1000000);
        list.add("composed", composed, "of how many maps compositions with self-maps are tried", 0, 100);
        list.add("finished", finishing.most, "maps that are finished and compared at most", 1, 100);
        varimap::describe(list, finishing.descriptors);
        landmark_reading.describe(list);
        list.add("landmark_weight", landmark_weight,
                 "how firmly landmarks hold (1: pinned; less: the map may disagree)", 1e-3, 1.0);
    }
};

}  // namespace varimap
