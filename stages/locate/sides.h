#pragma once

#include <vector>

#include "varimap/mesh/part_share.h"
#include "varimap/mesh/vertex_index.h"
#include "varimap/relaxation/placed_part.h"
#include "varimap/transport/alternating_minimization.h"

namespace varimap {

/// A part and its whole, whichever of them is the source, with vertices that are landmarks.
struct Sides {
    const Surface &part, &whole;
    std::vector<int> landmarks_part, landmarks_whole;

    Sides(const Surface& A, const Surface& B, const VertexPairs<MeshVertex>& landmarks, Part which)
        : part(which == Part::source ? A : B), whole(which == Part::source ? B : A) {
        for (const auto& [a, b] : landmarks) {
            landmarks_part.push_back(which == Part::source ? a.index : b.index);
            landmarks_whole.push_back(which == Part::source ? b.index : a.index);
        }
    }
    PartSize size() const { return part_size(part, landmarks_part, whole, landmarks_whole); }
};

/// Places the part on the whole from images of its vertices, with landmarks pinned.
PlacedPart place(PointMap images, const Sides& sides, double share, PartPlacing placing);

}  // namespace varimap
