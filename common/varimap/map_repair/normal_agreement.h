#pragma once

#include <vector>

#include "varimap/mesh/closest_point.h"
#include "varimap/sliding/along_target.h"
#include "varimap/sliding/image_memory.h"
#include "varimap/sliding/sliding_map.h"

namespace varimap {

/// Faces that cut through a thin feature (a finger, an ear): upright by the target's normals at their
/// corners, which the fold energy looks at, but not by those beneath their interior. They are few and lie
/// where the energy has many shallow minima, so their vertices are moved by a direct search: each to the best
/// of a fixed set of places around it, where a disagreeing face costs more than any strain worth having,
/// unless it does harm there along the target (along_target.h).
class NormalAgreement {
  public:
    /// Keeps references.
    NormalAgreement(SlidingMap& map, AlongTarget& along_target);

    /// Reversed faces, and those whose image triangle does not face the way the target does beneath it,
    /// ascending.
    std::vector<int> disagreeing_faces();
    /// Turns them; vertices with fixed[v] stay. Returns those that are left.
    std::vector<int> improve(std::vector<int> disagreeing, const VertexData<bool>& fixed);
    /// Those of `faces`, in their order.
    std::vector<int> disagreeing_among(const std::vector<int>& faces);

  private:
    bool disagrees(int f) const;
    /// A place for a vertex, and how strained and reversed the faces around it are there.
    struct Place {
        double strain;
        SurfacePoint point;
    };

    /// Of the faces around a vertex.
    double strain(int v) const;
    /// `cost`, and what those of them cost that disagree; some number above `limit` if that is exceeded.
    double with_disagreement(double cost, int v, double limit) const;
    /// Of the images of the edges at a vertex; 0 where it has none.
    double mean_edge(int v) const;
    /// Where to look for a better place, the least strained first.
    std::vector<Place> places_around(int v, double size);
    bool search(int v);

    SlidingMap& map_;
    AlongTarget& along_target_;
    ClosestPoint closest_;
    FaceMemory<bool>
        disagreement_;  ///< of whole sets of faces; a search would fill it with places left again
};

}  // namespace varimap
