#pragma once

#include <array>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

// What is known at the vertices of a mesh, linear on its faces: at a point with barycentric coordinates b on
// the corners v_k of its face it is sum_k b_k value(v_k). Points must not be nowhere.

/// The corners of a point's face with its coordinates there, without those of coordinate 0, which need no
/// value. To be gone through:
///     for (const auto [vertex, weight] : WeightedCorners(mesh, point)) sum += weight * value[vertex];
class WeightedCorners {
  public:
    struct Corner {
        int vertex;
        double weight;  ///< b_k
    };
    WeightedCorners(const TriangleMesh& mesh, const SurfacePoint& point) {
        for (int k = 0; k < 3; ++k)
            if (point.barycentric[k] != 0)
                corners_[size_++] = {mesh.faces(point.face, k), point.barycentric[k]};
    }
    const Corner* begin() const { return corners_.data(); }
    const Corner* end() const { return corners_.data() + size_; }

  private:
    std::array<Corner, 3> corners_;
    std::size_t size_ = 0;
};

/// Of numbers, one per vertex.
template <class Numbers>
double interpolated(const Numbers& values, const TriangleMesh& mesh, const SurfacePoint& point) {
    double sum = 0;
    for (const auto [vertex, weight] : WeightedCorners(mesh, point)) sum += weight * values[vertex];
    return sum;
}

/// Of rows, one per vertex; the result has one per point.
template <class Values>
Values pulled_back(const Values& values, const TriangleMesh& mesh, const PointMap& points) {
    Values result = Values::Zero(Eigen::Index(points.size()), values.cols());
    for (std::size_t i = 0; i < points.size(); ++i)
        for (const auto [vertex, weight] : WeightedCorners(mesh, points[i]))
            result.row(Eigen::Index(i)) += weight * values.row(vertex);
    return result;
}

/// Where points of a mesh lie in space: points x 3.
Points positions(const TriangleMesh& mesh, const PointMap& points);

/// The same of images on `target` that may be nowhere: there the rows of `fallback`.
Points image_positions(const PointMap& map, const TriangleMesh& target, const Points& fallback);

/// Where a map takes a point between vertices, straight through space: interpolated between the images of its
/// face's corners.
struct StraightImage {
    Vec3 place = Vec3::Zero();   ///< sum of b_k x_k over the corners that have an image x_k
    Vec3 normal = Vec3::Zero();  ///< sum of b_k n_k, n_k the unit normal of the face that x_k lies on
    double share = 0;            ///< sum of b_k
    bool is_whole = true;        ///< whether all corners have an image that have a b_k other than 0
};
/// `image_of`: of a vertex of the source.
template <class ImageOf>
StraightImage straight_image(const SurfacePoint& point, const TriangleMesh& source,
                             const TriangleMesh& target, ImageOf&& image_of) {
    StraightImage straight;
    for (const auto [vertex, weight] : WeightedCorners(source, point)) {
        const SurfacePoint image = image_of(vertex);
        if (image.face < 0) {
            straight.is_whole = false;
            continue;
        }
        straight.place += weight * position(target, image);
        straight.normal += weight * face_normal(target, image.face).stableNormalized();
        straight.share += weight;
    }
    return straight;
}
StraightImage straight_image(const SurfacePoint& point, const PointMap& map, const TriangleMesh& source,
                             const TriangleMesh& target);

}  // namespace varimap
