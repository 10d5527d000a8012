#pragma once

#include <utility>
#include <vector>

#include "varimap/core/indexed.h"
#include "varimap/geodesics/surface_walk.h"
#include "varimap/mesh/topology.h"
#include "varimap/mesh/triangle_mesh.h"
#include "varimap/sliding/fold_energy.h"

namespace varimap {

/// Two orthonormal directions in a face's plane, as columns.
using TangentFrame = Eigen::Matrix<double, 3, 2>;

/// A map whose images slide on the target: the state that the relaxations of untangling.h work on. Both
/// meshes are brought to unit area.
class SlidingMap {
  public:
    SlidingMap(const PointMap& map, const TriangleMesh& source, const TriangleMesh& target);

    const TriangleMesh& source() const { return source_; }
    const TriangleMesh& target() const { return target_; }
    const PointMap& points() const { return points_; }
    const SurfacePoint& point(int v) const { return points_[v]; }
    const Adjacency& faces_of_vertex() const { return faces_of_vertex_; }
    /// The faces that have one of these vertices as a corner; ascending.
    std::vector<int> faces_around(const std::vector<int>& vertices) const;
    const RestTriangle& rest(int f) const { return rest_[f]; }
    bool has_image(int v) const { return points_[v].face >= 0; }
    /// Whether a face counts: it has area, and all its corners have an image.
    bool is_mapped(int f) const {
        const auto corners = source_.faces.row(f);
        return rest_[f].area > 0 && has_image(corners[0]) && has_image(corners[1]) && has_image(corners[2]);
    }
    /// Which corner of a face of the source a vertex is.
    int corner_of(int f, int v) const {
        const auto corners = source_.faces.row(f);
        return corners[0] == v ? 0 : corners[1] == v ? 1 : 2;
    }
    /// Position in space of a vertex's image.
    const Vec3& image(int v) const { return image_[v]; }
    /// Sum of the target's normals at a face's three images.
    Vec3 normal_sum(int f) const {
        const auto corners = source_.faces.row(f);
        return normal_[corners[0]] + normal_[corners[1]] + normal_[corners[2]];
    }
    /// From the image of corner k of a face to those of the next corner and of the one after.
    std::pair<Vec3, Vec3> image_sides(int f, int k) const {
        const auto corners = source_.faces.row(f);
        const Vec3& x = image_[corners[k]];
        return {image_[corners[(k + 1) % 3]] - x, image_[corners[(k + 2) % 3]] - x};
    }
    /// Normal of a face's straight image, of twice its area.
    Vec3 chord_normal(int f) const {
        const auto [a, b] = image_sides(f, 0);
        return a.cross(b);
    }
    ImageTriangle image_triangle(int f) const {
        const auto corners = source_.faces.row(f);
        return {rest_[f], image_[corners[0]], image_[corners[1]], image_[corners[2]], normal_sum(f)};
    }
    /// Of the target's face that holds the image.
    const TangentFrame& tangents(int v) const { return frames_[points_[v].face]; }
    /// Length of the longest of a vertex's edges on the source.
    double longest_edge(int v) const { return longest_edge_[v]; }
    /// Walks a vertex's image along a tangent vector, from where it is.
    void move(int v, const Vec3& step) { place(v, walk_(points_[v], step)); }
    void place(int v, const SurfacePoint& point) {
        points_[v] = point;
        image_[v] = position(target_, point);
        normal_[v] = position(normals_, point);
    }
    /// Images of these vertices, and the same laid back.
    PointMap points_of(const std::vector<int>& vertices) const;
    void place(const std::vector<int>& vertices, const PointMap& points);
    /// Lays all images that there are back to those of a copy of points().
    void restore(const PointMap& points);
    /// Rest areas of faces times `factor`: the relaxations then aim at lengths times its root.
    void scale_rest(const std::vector<int>& faces, double factor) {
        for (const int f : faces) rest_[f].area *= factor;
    }
    void set_area_weight(int f, double weight) { rest_[f].area_weight = weight; }
    /// Takes a vertex's image away.
    void clear(int v) { points_[v].face = -1; }
    /// Where a walk from a point of the target ends.
    SurfacePoint walk(const SurfacePoint& from, const Vec3& step) const { return walk_(from, step); }
    /// Interpolated normal of the target at a vertex's image; not of unit length.
    const Vec3& normal(int v) const { return normal_[v]; }

  private:
    TriangleMesh source_, target_, normals_;  ///< normals_: the target's, as a mesh to interpolate on
    FaceData<RestTriangle> rest_;
    Adjacency faces_of_vertex_;
    VertexData<double> longest_edge_;
    FaceData<TangentFrame> frames_;  ///< of the target
    SurfaceWalk walk_;
    VertexData<SurfacePoint> points_;
    VertexData<Vec3> image_, normal_;
};

/// Areas on the source, which has unit area.
double area_of(const SlidingMap& map, const std::vector<int>& faces);
double area_of(const SlidingMap& map, const FaceData<bool>& marked);

/// How many corners of a face are marked.
inline int marked_corners(const TriangleMesh& mesh, int f, const VertexData<bool>& marks) {
    int count = 0;
    for (int k = 0; k < 3; ++k) count += marks[mesh.faces(f, k)] != 0;
    return count;
}
/// Marks all of them.
inline void mark_corners(const TriangleMesh& mesh, int f, VertexData<bool>& marks) {
    for (int k = 0; k < 3; ++k) marks[mesh.faces(f, k)] = true;
}

}  // namespace varimap
