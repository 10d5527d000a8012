#pragma once

#include <vector>

#include "stages/locate/part_size.h"
#include "stages/locate/placement.h"
#include "varimap/mesh/vertex_index.h"
#include "varimap/transport/alternating_minimization.h"

namespace varimap {

/// A part and its whole, whichever of them is the source, with vertices that are landmarks.
struct Sides {
    const Surface &part, &whole;
    std::vector<int> landmarks_part, landmarks_whole;

    Sides(const Surface& A, const Surface& B, const VertexPairs<MeshVertex>& landmarks, PartSide which)
        : part(which == PartSide::source ? A : B), whole(which == PartSide::source ? B : A) {
        for (const auto& [a, b] : landmarks) {
            landmarks_part.push_back(which == PartSide::source ? a.index : b.index);
            landmarks_whole.push_back(which == PartSide::source ? b.index : a.index);
        }
    }
    PartSize size() const { return part_size(part, landmarks_part, whole, landmarks_whole); }
    bool are_opposed() const { return part.mirrored != whole.mirrored; }
};

/// Places the part on the whole from images of its vertices, with landmarks pinned.
Placement pinned_placement(PointMap images, const Sides& sides, double share, const PlacingOptions& options);

}  // namespace varimap
