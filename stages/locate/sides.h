#pragma once

#include <array>
#include <vector>

#include "stages/locate/part_size.h"
#include "stages/locate/placement.h"
#include "varimap/core/enum_names.h"
#include "varimap/mesh/unit_area.h"
#include "varimap/mesh/vertex_index.h"
#include "varimap/spectral/local_shape.h"

namespace varimap {

/// Which surface is a part of the other.
enum class PartSide : int { none = 0, source = 1, target = 2 };
template <>
struct EnumNames<PartSide> {
    static constexpr std::array names{"none", "source", "target"};
};

/// A part and its whole, whichever of them is the source, with vertices that are landmarks.
struct Sides {
    const Surface &part, &whole;
    PairHandedness handedness;  ///< of the part, A, and the whole, B
    std::vector<int> landmarks_part, landmarks_whole;

    Sides(const Surface& A, const Surface& B, const VertexPairs<MeshVertex>& landmarks, PartSide which)
        : part(which == PartSide::source ? A : B),
          whole(which == PartSide::source ? B : A),
          handedness(part, whole) {
        for (const auto& [a, b] : landmarks) {
            landmarks_part.push_back(which == PartSide::source ? a.index : b.index);
            landmarks_whole.push_back(which == PartSide::source ? b.index : a.index);
        }
    }
    /// Whether landmarks say where the part is.
    bool landmarks_tell() const { return landmarks_part.size() >= 3; }
    /// By the landmarks where there are three, else that of the files: the one path between two may lead
    /// around what was cut off.
    PartSize size() const {
        return landmarks_tell() ? part_size(part, landmarks_part, whole, landmarks_whole)
                                : part_size(part, {}, whole, {});
    }
    /// What the placements between these sides have in common.
    std::vector<ReliefPair> reliefs() const {
        return relief_pairs(unit_area(part.mesh), unit_area(whole.mesh), handedness.are_opposite());
    }
};

/// Places the part on the whole from images of its vertices, with landmarks pinned. `reliefs`: of the sides.
Placement pinned_placement(PointMap images, const Sides& sides, double share,
                           const std::vector<ReliefPair>& reliefs, const PlacingOptions& options);

}  // namespace varimap
