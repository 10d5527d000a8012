#pragma once

#include <string>
#include <vector>

#include "varimap/landmarks/vertex_list.h"
#include "varimap/results/correspondence.h"

namespace varimap {

/// Landmarks with their names, where they have some.
struct NamedLandmarks {
    PointPairs points;
    std::vector<std::string> names;
};

/// What a page shows.
struct PageContent {
    Correspondence map;
    NamedLandmarks landmarks;
    std::string report;  ///< JSON of pipelines/report.jq, or empty
    bool mirrored = false;
};

/// The page: `frame`, a page with the program in it, with the meshes, the map and what there is to say about
/// it. Positions are rounded to 1/65535 of the mesh's extent, distortions to 1/32 of an octave, barycentric
/// coordinates to 1/65535; of larger surfaces 150,000 vertices are shown (thinning.h). Throws InputError
/// where `frame` has no place for them.
std::string viewer_page(const PageContent& content, const std::string& frame);

}  // namespace varimap
