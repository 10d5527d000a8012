#pragma once

#include <vector>

#include "varimap/core/indexed.h"
#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// Where a map takes a connected component of a surface, and the other direction comes back to it. Components
/// are numbered by their lowest vertices.
struct ComponentImage {
    int vertex = -1;      ///< its lowest
    double area = 0;      ///< its share of the surface's
    int onto = -1;        ///< the other's component that more of it lies on than on any other; -1: on none
    double on_that = 0;   ///< the share of its area that does
    double taken = 0;     ///< area of the other surface, as a share of that, which lies on it, by its own
    int orientation = 0;  ///< orientation_sign (boundary.h)

    /// Whether some of the other surface, half as large as it is, has its place there. A component may lie on
    /// another without: on what has a partner already.
    bool has_partner() const { return onto >= 0 && taken >= 0.5; }
};

/// The components of both surfaces, as the two directions of a map take them.
struct ComponentImages {
    std::vector<ComponentImage> of_source, of_target;

    bool are_several() const { return of_source.size() > 1 || of_target.size() > 1; }
    /// Whether components of both are without a partner, so that some may have been each other's.
    bool are_astray() const;
    /// Those of the source of which and of whose partner, which have each other, one looks inward and one
    /// outward, where that is not so of the largest; or the other way round, as where one surface is
    /// mirrored.
    std::vector<int> opposed() const;

  private:
    /// Of a component's orientation and of its partner's; 0 where they have not each other.
    int orientation_product(const ComponentImage& one) const;
};

/// `map` leads from `source` to `target`, `back` the other way. Vertices count by the area around them, those
/// without an image not at all.
ComponentImages measure_components(const PointMap& map, const PointMap& back, const TriangleMesh& source,
                                   const TriangleMesh& target);

}  // namespace varimap
