#pragma once

#include <utility>
#include <vector>

#include "common/mapping/pair_context.h"
#include "common/mapping/plan.h"
#include "common/shapes.h"

/// Pairs of generated surfaces with their true map.
namespace varimap::shapes {

/// Surfaces ready for the solving stages, and where the vertices of each one's mesh truly belong on the
/// other's.
struct KnownPair {
    SurfaceData A, B;
    Points A_on_B, B_on_A;
    std::vector<std::pair<int, int>> landmarks;  ///< vertices of the meshes

    PairContext context(double landmark_weight = 1) const {
        return PairContext(A, B, landmarks, landmark_weight);
    }
};

/// `rest` and `pose(other)`, where `other` is another tessellation of the surface `rest`; preprocessed, at
/// unit area. Landmarks: vertices nearest to the given points of the rest surface.
KnownPair known_pair(const TriangleMesh& rest, const TriangleMesh& other, const Pose& pose, int eigenpairs,
                     const std::vector<Vec3>& landmarks);

/// The figure and its pose, another tessellation, about 2700 vertices; landmarks at the feet of the forelegs,
/// at the left hind foot and at the tip of the tail, or none.
KnownPair figure_pair(double amount, bool with_landmarks);

/// The vertex of a mesh nearest to a point.
int nearest_vertex(const TriangleMesh& mesh, const Vec3& point);

/// Mean distance in space of a map's images from their true places.
double mean_error(const PointMap& map, const TriangleMesh& target, const Points& truth);
/// The larger of the mean errors of the two directions of a plan, read out, in units of sqrt(area).
double mean_error(const Plan& plan, const KnownPair& pair);

}  // namespace varimap::shapes
