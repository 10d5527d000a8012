#include "stages/locate/covered.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "varimap/core/index_set.h"
#include "varimap/core/parallel.h"
#include "varimap/mesh/closest_point.h"
#include "varimap/mesh/face_geometry.h"
#include "varimap/mesh/interpolation.h"
#include "varimap/mesh/topology.h"
#include "varimap/surface/input_locator.h"

namespace varimap {

namespace {

/// The image of a part, which has the part's faces.
class Image {
  public:
    Image(const PointMap& images, const TriangleMesh& part, const TriangleMesh& whole)
        : mesh_{image_positions(images, whole, part.vertices), part.faces},
          closest_(mesh_),
          on_rim_(part.vertex_count()),
          half_edge_on_rim_(std::size_t(3 * part.face_count()), false) {
        const Edges edges = find_edges(part);
        for (int e = 0; e < edges.size(); ++e) {
            if (edges.half_edges[e].size() != 1) continue;
            half_edge_on_rim_[std::size_t(edges.half_edges[e].front())] = true;
            for (const int v : edges.vertices[std::size_t(e)]) on_rim_[v] = true;
        }
    }
    /// Whether the closest point lies inside, not on the rim, and is no farther than the faces are large.
    bool covers(const Vec3& x, const Vec3& normal) const {
        const ClosestPoint::Hit hit = closest_(x, normal);
        const double far = longest_edge(mesh_, hit.point.face);
        return hit.squared_distance < far * far && !lies_on_rim(hit.point);
    }

  private:
    bool lies_on_rim(const SurfacePoint& point) const {
        for (int c = 0; c < 3; ++c) {
            const int next = (c + 1) % 3, after = (c + 2) % 3;
            const bool on_side = point.barycentric[after] <= 0,
                       at_corner = on_side && point.barycentric[next] <= 0;
            if (on_side && half_edge_on_rim_[std::size_t(3 * point.face + c)]) return true;
            if (at_corner && on_rim_[mesh_.faces(point.face, c)]) return true;
        }
        return false;
    }

    TriangleMesh mesh_;
    ClosestPoint closest_;
    VertexData<bool> on_rim_;
    std::vector<bool> half_edge_on_rim_;  ///< per half-edge of `mesh_`
};

}  // namespace

FaceData<char> covered_faces(const PointMap& images, const TriangleMesh& part, const Surface& whole) {
    const Image image(images, part, whole.mesh);
    const MeshLocator on_mesh(whole);
    FaceData<char> covered(whole.input.face_count());
    constexpr int grain = 1000;
    parallel_for_each_index(covered.size(), grain, [&](int f) {
        const SurfacePoint middle = on_mesh({f, Vec3::Constant(1.0 / 3)});
        covered[f] = image.covers(position(whole.mesh, middle), face_normal(whole.mesh, middle.face));
    });
    return covered;
}

FaceData<char> touched_faces(const PointMap& images, const TriangleMesh& part, const Surface& whole) {
    constexpr int grain = 100;
    constexpr int most = 32;  ///< samples along an edge
    // Of unit area: about two thirds of a face's edge.
    const double step = 1 / std::sqrt(double(whole.input.face_count()));
    const InputLocator on_input(whole);
    const Edges edges = find_edges(part);
    std::vector<std::vector<int>> along(std::size_t(edges.size()));
    parallel_for_each_index(edges.size(), grain, [&](int e) {
        const auto& [u, v] = edges.vertices[std::size_t(e)];
        const SurfacePoint &from = images[std::size_t(u)], &to = images[std::size_t(v)];
        if (from.face < 0 || to.face < 0) return;
        const Vec3 normal =
            face_normal(whole.mesh, from.face).normalized() + face_normal(whole.mesh, to.face).normalized();
        const Vec3 start = position(whole.mesh, from), way = position(whole.mesh, to) - start;
        const int steps = std::min(most, 1 + int(way.norm() / step));
        for (int k = 0; k <= steps; ++k)
            along[std::size_t(e)].push_back(on_input(start + k * way / steps, normal).face);
    });
    std::vector<int> found;
    for (const std::vector<int>& faces : along) found.insert(found.end(), faces.begin(), faces.end());
    std::erase(found, -1);
    make_set(found);
    FaceData<char> touched(whole.input.face_count());
    const Adjacency faces_of_vertex = vertex_faces(whole.input);
    for (const int v : vertices_of(whole.input, found))
        for (const int f : faces_of_vertex[v]) touched[f] = 1;
    return touched;
}

}  // namespace varimap
