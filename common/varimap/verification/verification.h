#pragma once

#include <optional>
#include <vector>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// What an independent look at a map finds (Sec. 4.4: flips). It shares nothing with the code that makes,
/// untangles or measures maps, so that a mistake there cannot hide here.
///
/// A source triangle is judged by its image triangle, whose corners are the images of its own. Left out are
/// triangles with a corner without image, and source triangles without area.
struct Verification {
    /// Source triangles with n . m <= 0: n the normal of the image triangle, m the sum of the unit normals of
    /// the target's FACES closest to seven of its inner points. Collapsed image triangles count. Ascending.
    std::vector<int> reversed_faces;
    double reversed_area_percent = 0;  ///< their share of the area of the triangles that were judged
    /// Source vertices around which the map winds twice or more, forwards or backwards: the images of the
    /// neighbours, joined in their order, go round the vertex's image at least 1.5 times, seen along the mean
    /// of the target's face normals there; and the image triangles' angles there, negative in reversed ones,
    /// sum to at least 1.25 times a full turn (of the target's vertex, where the image is one), so that no
    /// bend of the target is taken for a branch. The neighbours of a boundary vertex are not joined into a
    /// loop: it is found once its fan overlaps itself by half a turn. Ascending.
    std::vector<int> branch_vertices;
    /// Sum of the image triangles' areas, negative for reversed ones, by the area of the target. 1 for a good
    /// map of whole surfaces (a little less where image triangles cut across bends), the covered share for a
    /// map into a part.
    double signed_area_ratio = 0;
    /// Degree of the map (map_degree.h): how often it covers the target. 1 for a good map, -1 for a mirrored
    /// one. Found without the above. Only between closed surfaces, where every vertex has an image.
    std::optional<double> degree;
    int left_out_count = 0;  ///< triangles left out for want of an image
};

/// `map` has one row per vertex of `source`, on faces of `target`. The same for any number of threads.
Verification verify_map(const PointMap& map, const TriangleMesh& source, const TriangleMesh& target);

}  // namespace varimap
