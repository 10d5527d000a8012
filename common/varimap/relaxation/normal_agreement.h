#pragma once

#include <vector>

#include "varimap/mesh/closest_point.h"
#include "varimap/relaxation/face_memory.h"
#include "varimap/relaxation/sliding_map.h"

namespace varimap {

/// Faces that cut through a thin feature (a finger, an ear): upright by the target's normals at their
/// corners, which the fold energy looks at, but not by those beneath their interior. They are few and lie
/// where the energy has many shallow minima, so their vertices are moved by a direct search: each to the best
/// of a fixed set of places around it, where a disagreeing face costs more than any strain worth having.
class NormalAgreement {
  public:
    explicit NormalAgreement(SlidingMap& map);

    /// Reversed faces, and those whose image triangle does not face the way the target does beneath it,
    /// ascending.
    std::vector<int> disagreeing_faces();
    /// Turns them; vertices with fixed[v] stay. Returns those that are left.
    std::vector<int> improve(std::vector<int> disagreeing, const VertexData<bool>& fixed);
    /// Those of `faces`, in their order.
    std::vector<int> disagreeing_among(const std::vector<int>& faces);
    /// Whether the images of a face's corners lie around one vertex of the target with faces that the image
    /// triangle all agrees with: nothing is in doubt then.
    bool lies_within_a_star(int f) const;

  private:
    bool disagrees(int f) const;
    bool lies_within_a_star(int f, const Vec3& normal) const;
    Vec3 chord_normal(int f) const;
    /// Of the faces around a vertex; some number above `limit` if that is exceeded.
    double cost(int v, double limit) const;
    bool search(int v);

    SlidingMap& map_;
    ClosestPoint closest_;
    Adjacency target_faces_;   ///< per vertex of the target
    FaceMemory disagreement_;  ///< of whole sets of faces; a search would fill it with places left again
};

}  // namespace varimap
