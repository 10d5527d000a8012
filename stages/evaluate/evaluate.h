#pragma once

#include <string>
#include <vector>

#include "varimap/landmarks/vertex_list.h"
#include "varimap/mesh_repair/mesh_repair.h"
#include "varimap/results/map_file.h"
#include "varimap/verification/evaluation.h"

namespace varimap {

/// What a map is compared with; all by files, and by the numbers these have.
struct EvaluateRequest {
    std::string target_mesh;          ///< the map leads to it
    std::string map;                  ///< map_file.h
    std::vector<std::string> points;  ///< two lists of vertices; with source_mesh landmarks in any form
    std::string source_mesh = {};  ///< the map starts from it; empty: vertices of the source are not checked
    RepairOptions repair = {};     ///< of the target, as varimap-preprocess did it
    IndexBase map_base = IndexBase::automatic;
    LandmarkReading reading = {};  ///< of the points

    template <class List>
    void describe(List& list) {
        repair.describe(list);
        list.add("index_base", reading.base,
                 "number of a list's first vertex; auto: coordinates in the list decide, a 0, or a number as "
                 "large as there are vertices; else 0");
        list.add("landmark_space", reading.space,
                 "axes of points: stated by their file, as-is (those of the mesh), lps or ras");
        list.add("map_base", map_base, "number of the first vertex in a map of vertices to vertices");
    }
};

/// Geodesic errors of a map (evaluation.h), where `points` say each point of the source belongs. What a
/// repair has taken from the target counts as unmapped. Throws UsageError for more than two files of points,
/// or landmarks without a source; InputError for what does not fit together; IoError.
MapErrors evaluate(const EvaluateRequest& request);

/// Reads the meshes and the points as evaluate does, before there is a map. Throws for these as evaluate
/// does; numbers of the source's vertices are checked where source_mesh is given.
void check_points(const EvaluateRequest& request);

/// The numbers, one per line.
std::string as_text(const MapErrors& errors);
/// An object: pairs, unmapped, mean, smoothed_mean (absent if it has none), median, maximum, and the shares
/// within .025, .05 and .1: share_0025, share_005, share_01.
std::string as_json(const MapErrors& errors);

}  // namespace varimap
