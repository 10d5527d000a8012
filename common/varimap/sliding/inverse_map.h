#pragma once

#include <memory>

#include "varimap/sliding/sliding_map.h"

namespace varimap {

/// The inverse of the other direction, by which each direction of a map can learn from the other: a vertex of
/// the source goes to the point of the target whose image, linear on faces, is nearest to it among those that
/// face the same way.
class InverseMap {
  public:
    /// `back`: from the target of `map` to its source; empty where that is not known. Keeps references;
    /// nothing is built before it is asked.
    InverseMap(const SlidingMap& map, const PointMap& back);
    ~InverseMap();

    /// The image of a vertex; its face is -1 where the target's faces there have no image, or nothing is
    /// known.
    SurfacePoint operator()(int v);
    /// Places the marked vertices of `map`, the map it was made of, on their images.
    void place(SlidingMap& map, const VertexData<bool>& marked);

  private:
    struct Search;
    const SlidingMap& map_;
    const PointMap& back_;
    std::unique_ptr<Search> search_;
};

/// `back`, which leads from `source` to `target`, with its marked vertices placed by the inverse of `there`.
PointMap laid_by_inverse(PointMap back, const PointMap& there, const TriangleMesh& source,
                         const TriangleMesh& target, const VertexData<bool>& marked);

}  // namespace varimap
