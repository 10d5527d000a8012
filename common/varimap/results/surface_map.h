#pragma once

#include <string>

#include "varimap/artifact/artifact.h"
#include "varimap/results/untangling_report.h"
#include "varimap/surface/surface.h"

namespace varimap {

/// The dense map in both directions, between the mesh FILES: the artifact of varimap-relax. A_to_B has one
/// row per vertex of A's file, in its order, on faces of B's file; face -1 for vertices that have no image
/// (file_link.h says why).
struct SurfaceMap {
    PointMap A_to_B;
    PointMap B_to_A;
    UntanglingReports untangling;
};

template <>
struct ArtifactType<SurfaceMap> {
    static constexpr const char* kind = "map";
    static constexpr const char* stage = "varimap-relax";
    static constexpr int schema = 2;
};
std::string encode(const SurfaceMap& map);
/// Throws ArtifactError unless points are points and numbers of the reports are finite.
void decode(const std::string& payload, SurfaceMap& map);

/// Throws ArtifactError if the map is not one between the files of these surfaces.
void require_surfaces(const SurfaceMap& map, const Surface& A, const Surface& B);

}  // namespace varimap
