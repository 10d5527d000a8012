#pragma once

#include <utility>
#include <vector>

#include "varimap/core/indexed.h"
#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

// How good a map is, measured on the meshes it is given for. Both are first brought to unit area, so lengths
// are in units of sqrt(area) and nothing depends on the inputs' scale. A source triangle is compared with its
// IMAGE triangle, whose corners are the images of its own. Left out everywhere: vertices without an image,
// triangles with such a corner, and source triangles without area. All numbers are finite, and the same for
// any number of threads.

/// Quantiles at 1, 5, 50, 95 and 99%.
struct Quantiles {
    double p01 = 0, p05 = 0, p50 = 0, p95 = 0, p99 = 0;
};
/// Smallest value up to which that share of the weight lies. Zeros if there is no weight.
double weighted_quantile(const std::vector<double>& values, const std::vector<double>& weights, double share);
Quantiles weighted_quantiles(const std::vector<double>& values, const std::vector<double>& weights);

/// Conformal distortion of image triangles that are collapsed to a segment or a point.
inline constexpr double conformal_distortion_cap = 1e6;

/// What one source triangle contributes; area 0: nothing.
struct TriangleDistortion {
    double area = 0;          ///< of the source triangle
    double area_ratio = 0;    ///< image area / source area
    double conformal = 1;     ///< sigma_1 / sigma_2
    double squared_norm = 0;  ///< |J|_F^2
    bool flipped = false, collapsed = false;
};
/// Per source face.
FaceData<TriangleDistortion> measure_triangles(const PointMap& map, const TriangleMesh& source,
                                               const TriangleMesh& target);

/// Of a whole map.
struct Distortion {
    /// Triangles with n . m <= 0: n the normal of the image triangle, m the sum of the target's normals
    /// (angle-weighted at vertices, interpolated) at the three images. Collapsed triangles count as flipped.
    int flipped_count = 0;
    double flipped_area_percent = 0;  ///< their share of the source's area
    int collapsed_count = 0;          ///< image triangles without area
    Quantiles area_ratio;  ///< image area / source area, both of unit total; weighted by source area
    /// sigma_1 / sigma_2 >= 1 of the linear map onto the image triangle, weighted by source area; 1:
    /// conformal.
    Quantiles conformal_distortion;
    /// 1/2 sum area |J|_F^2 = 1/2 sum area (sigma_1^2 + sigma_2^2); 1 for an isometry.
    double dirichlet_energy = 0;
};
Distortion measure_distortion(const PointMap& map, const TriangleMesh& source, const TriangleMesh& target);
/// The same of triangles that were measured already.
Distortion measure_distortion(const FaceData<TriangleDistortion>& triangles);

/// Share of the source's area around vertices whose faces together have an image of 1/bound to `bound` times
/// their area, both surfaces of unit area: how far a map keeps the bound of Sec. 3.4 where it is finished.
/// Bounds below 1.05 count as 1.05: no finished map keeps areas exactly. `triangles`: measure_triangles.
double share_within_area_bound(const FaceData<TriangleDistortion>& triangles, const TriangleMesh& source,
                               double bound);

/// Part of the target that a map does not hit: what has no partner on the source, or what the map passes by.
struct UncoveredPart {
    double share = 0;  ///< of the target's area
    /// Of the target: a corner of its faces that no other part has, if there is one, and of such corners the
    /// nearest to the faces' centroid.
    int vertex = -1;
};

/// What of the target a map hits.
struct Coverage {
    double share = 0;                  ///< of the target's area that is hit
    std::vector<UncoveredPart> parts;  ///< connected, of at least 0.005 of the target's area; largest first
};

/// What of the target is hit. A target face is hit if its centroid c lies in front of or behind
/// the image of the source: with p the closest point to c on the image triangles that face the way c does,
/// and q the closest point to p back on the target, |q - c| is at most 0.8 |p - c| or 0.05 of the face's
/// longest edge. (Where no image is near, p lies at the rim of the image and q beside it, so |q - c| is about
/// |p - c|.) Flipped image triangles count whichever way they face: a flip is not a gap. Where the source has
/// a quarter of the target's faces or fewer, they are cut in four first, the middles of their sides mapped to
/// the closest points of the target that face as the sides' ends do.
Coverage measure_coverage(PointMap map, TriangleMesh source, const TriangleMesh& target);

/// Distance in R^3 of each vertex of A from its image under A -> B -> A, in units of sqrt(area of A),
/// weighted by the vertices' areas. B_to_A is taken linear on the faces of B (image triangles).
struct RoundTrip {
    double mean = 0, p95 = 0;
};
RoundTrip measure_round_trip(const PointMap& A_to_B, const PointMap& B_to_A, const TriangleMesh& A,
                             const TriangleMesh& B);

/// Distance in R^3 between the image of the first point of each pair (linear on the source's faces, by those
/// of the corners that have an image; 0 where none has) and the second point, in units of sqrt(area of the
/// target).
std::vector<double> landmark_residuals(const PointMap& map, const PointPairs& landmarks,
                                       const TriangleMesh& source, const TriangleMesh& target);

/// Whether a map agrees around a landmark with what it does at it. A landmark that is pinned is met exactly,
/// but the map may be elsewhere all around it: then it ends in a spike there.
struct LandmarkSurroundings {
    /// From where they are taken, in the mean, to the landmark's partner; units of sqrt(area of the target).
    double distance = 0;
    double radius = 0;  ///< their mean distance from the landmark, in units of sqrt(area of the source)
    Vec3 image = Vec3::Zero();  ///< where they are taken, in the mean; in the target's own coordinates
};
/// The surroundings of a landmark are the vertices that share a face with a corner which it lies at, but
/// those corners; distances are in space.
std::vector<LandmarkSurroundings> landmark_surroundings(const PointMap& map, const PointPairs& landmarks,
                                                        const TriangleMesh& source,
                                                        const TriangleMesh& target);
/// Landmarks that look exchanged, as pairs of indices, the lesser first, ascending: the surroundings of each
/// are taken farther from its own partner than their radius, and to less than half that distance from the
/// other's. A landmark is in one pair at most.
std::vector<std::pair<int, int>> exchanged_landmarks(const std::vector<LandmarkSurroundings>& surroundings,
                                                     const PointPairs& landmarks, const TriangleMesh& target);

}  // namespace varimap
