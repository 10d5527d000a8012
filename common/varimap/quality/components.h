#pragma once

#include <vector>

#include "varimap/core/indexed.h"
#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// Where a map takes a connected component of the source. Components are numbered by their lowest vertices.
struct ComponentImage {
    int vertex = -1;     ///< its lowest
    double area = 0;     ///< its share of the source's
    int onto = -1;       ///< the component of the target that more of it lies on than on others; -1: on none
    double on_that = 0;  ///< the share of its area that does
    /// Whether most of that component lies on this one in turn.
    bool has_partner = false;
};

/// The components of both surfaces, as the two directions of a map take them.
struct ComponentImages {
    std::vector<ComponentImage> of_source, of_target;

    bool are_several() const { return of_source.size() > 1 || of_target.size() > 1; }
    /// Whether components of both are without a partner, so that some may have been each other's.
    bool are_astray() const;
};

/// `map` leads from `source` to `target`, `back` the other way. Vertices count by the area around them, those
/// without an image not at all.
ComponentImages measure_components(const PointMap& map, const PointMap& back, const TriangleMesh& source,
                                   const TriangleMesh& target);

}  // namespace varimap
