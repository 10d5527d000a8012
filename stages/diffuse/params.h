#pragma once

#include <array>

#include "varimap/landmarks/vertex_list.h"
#include "varimap/mesh_files/index_base.h"
#include "varimap/pair_stage/alternation_params.h"

namespace varimap {

/// Where the centres of the coarsest level begin.
enum class FirstCentres : int {
    zero = 0,         ///< at the origin of the embeddings
    wasserstein = 1,  ///< those of the Wasserstein-2 plan, for aligned surfaces
};
template <>
struct EnumNames<FirstCentres> {
    static constexpr std::array names{"zero", "wasserstein"};
};

struct DiffuseParams {
    AlternationOptions alternation;
    IroningOptions ironing;
    FirstCentres start = FirstCentres::zero;
    double wasserstein_weight =
        0;  ///< share of the Wasserstein-2 cost added to Eq. (3), for aligned surfaces
    DescriptorWeights descriptors;
    int candidate = 1;                          ///< which of the candidates of varimap-explore is continued
    IndexBase map_base = IndexBase::automatic;  ///< of an initial map
    LandmarkReading landmark_reading;
    double landmark_weight = 1;   ///< W of pull_landmarks (cost.h); 1: pinned
    bool check_landmarks = true;  ///< compares the map with one that lacks each landmark in turn
    int levels = 0;               ///< stop after this many diffusion levels; 0: all

    void describe(ParameterList& list) {
        varimap::describe(list, alternation);
        varimap::describe(list, ironing);
        list.add("start", start, "first centres: zero, or wasserstein for rigidly aligned surfaces (Sec. 5)");
        list.add("wasserstein_weight", wasserstein_weight,
                 "weight of the Wasserstein-2 cost beside Eq. (3), relative; for aligned surfaces (Sec. 2.3)",
                 0.0, 100.0);
        varimap::describe(list, descriptors);
        list.add("candidate", candidate,
                 "which of the maps that varimap-explore found is continued (1: the best)", 1, 100);
        list.add("map_base", map_base,
                 "number of the first vertex in an initial map from vertices to vertices: 0, 1, or auto");
        landmark_reading.describe(list);
        list.add("landmark_weight", landmark_weight,
                 "how firmly landmarks hold (1: pinned; less: the map may disagree)", 1e-3, 1.0);
        list.add("check_landmarks", check_landmarks, "names landmarks that the others contradict");
        list.add("levels", levels, "stop after this many diffusion levels (0: all)", 0, 1000);
    }
};

}  // namespace varimap
