#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// Errors of a map against known correspondences, in units of the square root of the target's area (Sec. 6,
/// Fig. 18).
struct MapErrors {
    std::vector<double> errors;  ///< per evaluated pair: geodesic distance from the image to the true image
    int unmapped = 0;  ///< pairs left out because the map gives their source vertex no image, or their
                       ///< target vertex is -1
    int apart = 0;     ///< images on another component than the true one; their errors are straight distances
    /// Mean length of displacements in space, true image to image, once each is averaged over the 12 true
    /// images nearest to it. True images that were rounded to vertices are wrong by half an edge, each in its
    /// own direction, which averages out; what a map does wrong, neighbours share. None for fewer than 500
    /// pairs, which are too sparse.
    std::optional<double> smoothed_mean = {};

    double mean() const;
    double median() const;
    double maximum() const;
    /// Share of the pairs with an error of at most `bound`.
    double share_within(double bound) const;
};

/// map: per source vertex, on faces of `target`. Pair i says that vertex source_points[i] belongs on
/// target_points[i]. Throws InputError: lists of different lengths, vertices or faces that do not exist,
/// vertices that no face uses, no pair with an image. `name`: of the map, for them.
MapErrors map_errors(const PointMap& map, const TriangleMesh& target, const std::vector<int>& source_points,
                     const std::vector<int>& target_points, const std::string& name = "the map");

/// The same for points that are given as such: pair by pair, where a map takes a point, and where it belongs.
/// Pairs that are nowhere count as unmapped.
MapErrors point_errors(const PointPairs& images_and_truths, const TriangleMesh& target,
                       const std::string& name = "the map");

/// The cumulative curve of Fig. 18 as CSV: `error,share` from 0 to 0.25 in steps of 0.0025.
std::string curve_csv(const MapErrors& errors);

}  // namespace varimap
