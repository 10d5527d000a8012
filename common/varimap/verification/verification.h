#pragma once

#include <optional>
#include <vector>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// What an independent look at a map finds (Sec. 4.4: flips). Beyond geometry (mesh/, of which both
/// take logarithmic maps) it shares nothing with the code that makes, untangles or measures maps, so that a
/// mistake there cannot hide here.
///
/// A source triangle is judged by its image triangle as laid out on the target: its corners are the images of
/// its own, its sides shortest paths. Left out are triangles with a corner without image, and source
/// triangles without area. Maps between closed surfaces of equal genus, of degree 1 and without reversed
/// triangles, have no branch points (Riemann and Hurwitz).
struct Verification {
    /// Source triangles whose image is reversed or collapsed: the products u x v, summed over the three
    /// corners, are not positive, with u and v the others as seen from a corner along the surface
    /// (log_map.h). Ascending.
    std::vector<int> reversed_faces;
    double reversed_area_percent = 0;  ///< their share of the area of the triangles that were judged
    /// Those not reversed that would seem so if drawn with straight sides, and reversed ones that would not:
    /// n . m <= 0 with n the normal of that triangle and m the sum of the unit normals of the target's FACES
    /// closest to seven of its inner points. They cut through thin parts of the target, or sheets of it lie
    /// upon each other.
    int cutting_count = 0;
    /// Source vertices around which the map winds twice or more, forwards or backwards: the angles under
    /// which the images of the neighbours, joined in their order, are seen from the vertex's image sum to at
    /// least 1.5 turns. The neighbours of a boundary vertex are not joined into a loop: it is found once its
    /// fan overlaps itself by half a turn. Ascending.
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
