#pragma once

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// How far a finished map is from the initial map that it was made from. Distances are in space, weighted by
/// the vertices' areas, in units of sqrt(area of the target); vertices that lack one of the images are left
/// out.
struct InitialMapQuality {
    double mean = 0, p50 = 0, p95 = 0;
    /// Median distance between the images of neighbours under the initial map, where these are distinct: how
    /// fine that is. Of one with 60 distinct images it is as large as what one of them stands for.
    double step = 0;
};

/// Whether most of the source has moved far, and farther than the initial map's own steps: not where that was
/// coarse or noisy in most places, which a finished map leaves as it should.
bool moved_far(const InitialMapQuality& moved);

/// Both maps from the vertices of `source`, onto faces of `target`.
InitialMapQuality measure_initial_map(const PointMap& initial, const PointMap& finished,
                                      const TriangleMesh& source, const TriangleMesh& target);

}  // namespace varimap
