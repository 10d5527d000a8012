#pragma once

#include <optional>
#include <vector>

#include "varimap/quality/twist.h"
#include "varimap/untangling/untangling.h"

namespace varimap {

/// What takes a tube's twist out: rings are turned back by what is summed up to them, and what lies behind
/// the tube by all of it; but if that is about a full turn or several, just these are taken out, and what
/// lies behind stays. Which part of the tube stays, the caller chooses: the image of vertex v goes straight
/// on along the target by (reference - turn[v]) around[v].
struct Untwisting {
    Twist twist;
    std::vector<double> turn;  ///< per vertex of the source, in radians
    std::vector<Vec3> around;  ///< per vertex: tangent to the image of its ring, as long as the ring's radius
};
/// Of the tube of measure_twist; none where that is twisted by less than `least` degrees, or where what lies
/// behind it leads around to what lies before it and is not turned fully.
std::optional<Untwisting> untwisting(const PointMap& map, const TriangleMesh& source,
                                     const TriangleMesh& target, double least);

/// untangle (untangling.h); and where it leaves a tube twisted, such as a shaft (quality/twist.h), which the
/// energy of an isometry hardly resists, once more from the maps with the twist taken out, and so with half
/// as large a twist that is left. Those that are nearer to isometries are kept. Landmarks that hold the twist
/// leave it.
UntanglingReports untangle_untwisted(MapPair& maps, const TriangleMesh& A, const TriangleMesh& B,
                                     const PinnedPair& pinned, const UntanglingOptions& options);

}  // namespace varimap
