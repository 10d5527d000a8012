#pragma once

#include "varimap/mesh/triangle_mesh.h"
#include "varimap/mesh/vertex_index.h"
#include "varimap/quality/quality.h"

namespace varimap {

/// What may be said of a pair of surfaces; all else is as the stages have it by default.
struct MapOptions {
    VertexPairs<InputVertex> landmarks;  ///< without any, the map is looked for (varimap-explore)
    double landmark_weight = 1;          ///< how firmly landmarks hold, 0.001 to 1; 1: mapped exactly
    PointMap initial_map;          ///< per vertex of A, on B: a map to refine instead of looking for one
    bool explore = false;          ///< with landmarks, too; else only where they lead to a doubtful map
    int candidate = 1;             ///< which of the maps that were found is continued, 1 to 100; 1: the best
    bool full_resolution = false;  ///< solves on all vertices of large meshes, not on coarse ones
    bool mirror = false;           ///< the surfaces are of opposite handedness
    /// Areas change by at most this factor, 1 to 1e6, measured on the masses (Sec. 3.4).
    double area_bound = 2;
};

/// How good the map is in one direction (quality.h).
struct DirectionQuality {
    Distortion distortion;
    double coverage = 0;  ///< share of the other surface's area that is hit
};

/// The map between two meshes in both directions, and its quality; lengths in units of sqrt(area).
struct MappedSurfaces {
    PointMap A_to_B;  ///< per vertex of A, in A's order, on faces of B; face -1 where a vertex has no image
    PointMap B_to_A;
    DirectionQuality A_to_B_quality, B_to_A_quality;
    RoundTrip round_trip;  ///< A -> B -> A
};

/// Maps two surfaces onto each other: what `varimap map` does (Mandad et al. 2017, Alg. 5 and Sec. 5), in
/// memory, with the same result to the last bit. Both are mapped as wholes: finding the place of a part and
/// cutting the other surface there (`--part`) is not in it. Meshes are repaired where need be
/// (mesh_repair.h). Deterministic, for any number of threads; logs go to stderr. Minutes of time for 20'000
/// vertices. Throws Error (error.h): UsageError for options outside their ranges, that contradict each other,
/// and for a candidate there is none of; InputError for faces, landmarks or an initial map that name what the
/// meshes have not, landmarks that share a vertex, and for meshes that the method cannot serve;
/// ConvergenceError. Options and numbers of vertices and faces are checked before any work. In messages A is
/// the source, B the target.
MappedSurfaces map_surfaces(const TriangleMesh& A, const TriangleMesh& B, const MapOptions& options = {});

}  // namespace varimap
