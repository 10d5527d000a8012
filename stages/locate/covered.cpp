#include "stages/locate/covered.h"

#include "varimap/core/parallel.h"
#include "varimap/mesh/boundary.h"
#include "varimap/mesh/closest_point.h"
#include "varimap/mesh/face_geometry.h"
#include "varimap/mesh/input_locator.h"

namespace varimap {

namespace {

TriangleMesh image_mesh(const PointMap& images, const TriangleMesh& part, const TriangleMesh& whole) {
    TriangleMesh mesh = part;
    for (int v = 0; v < part.vertex_count(); ++v)
        mesh.vertices.row(v) = position(whole, images[std::size_t(v)]).transpose();
    return mesh;
}

/// The image of a part, which has the part's faces.
class Image {
  public:
    Image(const PointMap& images, const TriangleMesh& part, const TriangleMesh& whole)
        : mesh_(image_mesh(images, part, whole)), closest_(mesh_), is_rim_(part.vertex_count()) {
        for (const auto& edge : find_boundary(part).edges)
            for (const int v : edge) is_rim_[v] = true;
    }
    /// Whether the closest point lies inside, not on the rim, and is no farther than the faces are large.
    bool covers(const Vec3& x, const Vec3& normal) const {
        const ClosestPoint::Hit hit = closest_(x, normal);
        const double far = longest_edge(mesh_, hit.point.face);
        return hit.squared_distance < far * far && !lies_on_rim(hit.point);
    }

  private:
    bool lies_on_rim(const SurfacePoint& point) const {
        for (int c = 0; c < 3; ++c)
            if (point.barycentric[c] > 0 && !is_rim_[mesh_.faces(point.face, c)]) return false;
        return true;
    }

    TriangleMesh mesh_;
    ClosestPoint closest_;
    VertexData<bool> is_rim_;
};

}  // namespace

FaceData<char> covered_faces(const PointMap& images, const TriangleMesh& part, const Surface& whole) {
    const Image image(images, part, whole.mesh);
    const MeshLocator on_mesh(whole);
    FaceData<char> covered(whole.input.face_count());
    constexpr int grain = 1000;
    parallel_for_each_index(covered.size(), grain, [&](int f) {
        const SurfacePoint middle = on_mesh({f, Vec3::Constant(1.0 / 3)});
        if (middle.face >= 0)
            covered[f] = image.covers(position(whole.mesh, middle), face_normal(whole.mesh, middle.face));
    });
    return covered;
}

}  // namespace varimap
