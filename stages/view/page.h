#pragma once

#include <optional>
#include <string>
#include <vector>

#include "stages/view/texture.h"
#include "varimap/landmarks/vertex_list.h"
#include "varimap/results/correspondence.h"

namespace varimap {

/// Landmarks with their names, where they have some.
struct NamedLandmarks {
    PointPairs points;
    std::vector<std::string> names;
};

/// A map that the choice was among, rough.
struct PageCandidate {
    std::string relation;  ///< to the best: "the best", "mirrored"
    PointMap back;         ///< per vertex of the target's file: where it lies on the source
};

/// What a page shows.
struct PageContent {
    Correspondence map;
    NamedLandmarks landmarks;
    std::string report;  ///< JSON of pipelines/report.jq, or empty
    bool mirrored = false;
    std::optional<PageTexture> texture = {};
    std::vector<PageCandidate> candidates = {};
};

/// Vertices of a surface of more are not shown.
inline constexpr int most_shown = 150000;
/// Whether a surface of the map has more.
bool is_thinned(const Correspondence& map);

/// The page: `frame`, a page with the program in it, with the meshes, the map and what there is to say about
/// it. Positions are rounded to 1/65535 of the mesh's extent, distortions to 1/32 of an octave, barycentric
/// coordinates to 1/65535; of larger surfaces 150,000 vertices are shown (thinning.h), without texture and
/// candidates. Throws InputError where `frame` has no place for them.
std::string viewer_page(const PageContent& content, const std::string& frame);

}  // namespace varimap
