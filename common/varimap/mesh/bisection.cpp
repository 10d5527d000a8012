#include "varimap/mesh/bisection.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>
#include <vector>

#include "varimap/mesh/private/half_edge_mesh.h"
#include "varimap/mesh/topology.h"

namespace varimap {
namespace {

struct Traits : OpenMesh::DefaultTraitsDouble {
    FaceTraits {
        int origin;  ///< the face before it lies in
    };
};
using BisectedMesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;

/// One edge waiting to be split. Lengths are compared on a logarithmic grid, so that rounding cannot reorder
/// edges of equal length.
struct Candidate {
    int length;         ///< on the grid
    int surroundings;   ///< on the grid: total squared length of the sides of the faces beside it
    int lower, higher;  ///< vertices
    OpenMesh::EdgeHandle edge;

    bool operator<(const Candidate& other) const {
        return std::tie(length, surroundings, other.lower, other.higher) <
               std::tie(other.length, other.surroundings, lower, higher);
    }
};

int on_grid(double squared) {
    return squared > 0 ? int(std::lround(4096 * std::log2(squared))) : -10'000'000;
}

class Bisector {
  public:
    Bisector(const TriangleMesh& mesh, double target_length);
    void run(std::size_t max_vertices);
    Bisection result() const;

  private:
    void offer(OpenMesh::SmartEdgeHandle e);
    void split(OpenMesh::SmartEdgeHandle e);
    Vec3 on_face(int v, int origin) const;

    const TriangleMesh& before_;
    BisectedMesh mesh_;
    PointMap on_origin_;
    std::priority_queue<Candidate> queue_;
    double limit_;  ///< squared; edges that exceed the target by rounding only are kept
};

Bisector::Bisector(const TriangleMesh& mesh, double target_length)
    : before_(mesh),
      mesh_(half_edges<BisectedMesh>(mesh)),
      on_origin_(points_at_vertices(mesh)),
      limit_(target_length * target_length * (1 + 1e-9)) {
    for (const auto f : mesh_.faces()) mesh_.data(f).origin = f.idx();
    for (const auto e : mesh_.edges()) offer(e);
}

void Bisector::offer(OpenMesh::SmartEdgeHandle e) {
    const double squared = mesh_.calc_edge_sqr_length(e);
    if (!(squared > limit_)) return;
    double surroundings = 0;
    for (const auto beside : {e.h0(), e.h1()})
        if (!beside.is_boundary())
            for (const auto side : beside.loop()) surroundings += mesh_.calc_edge_sqr_length(side);
    const auto [lower, higher] = std::minmax({e.v0().idx(), e.v1().idx()});
    queue_.push({on_grid(squared / limit_), on_grid(surroundings / limit_), lower, higher, e});
}

void Bisector::run(std::size_t max_vertices) {
    while (!queue_.empty() && mesh_.n_vertices() < max_vertices) {
        const auto longest = queue_.top().edge;
        queue_.pop();
        split(OpenMesh::make_smart(longest, mesh_));
    }
}

/// Splits edge e at its midpoint. e becomes one of the halves, and is the only edge that changes.
void Bisector::split(OpenMesh::SmartEdgeHandle e) {
    int origin = before_.face_count();
    for (const auto beside : {e.h0(), e.h1()})
        if (!beside.is_boundary()) origin = std::min(origin, mesh_.data(beside.face()).origin);
    const int a = e.v0().idx(), b = e.v1().idx();
    on_origin_.push_back({origin, 0.5 * (on_face(a, origin) + on_face(b, origin))});
    const auto midpoint = mesh_.split_copy(e, mesh_.calc_edge_midpoint(e));
    for (const auto around : midpoint.edges()) offer(around);
}

/// Where vertex v lies on a face before that holds it. If it is noted on another one, it lies on their common
/// side, or is their common corner: only common corners have coordinates other than zero.
Vec3 Bisector::on_face(int v, int origin) const {
    const auto& [noted, barycentric] = on_origin_[v];
    if (noted == origin) return barycentric;
    Vec3 result = Vec3::Zero();
    for (int c = 0; c < 3; ++c)
        for (int k = 0; k < 3; ++k)
            if (before_.faces(origin, c) == before_.faces(noted, k)) result[c] = barycentric[k];
    return result;
}

Bisection Bisector::result() const {
    Bisection result;
    result.mesh.vertices.resize(mesh_.n_vertices(), 3);
    for (const auto v : mesh_.vertices())
        for (int k = 0; k < 3; ++k) result.mesh.vertices(v.idx(), k) = mesh_.point(v)[k];
    result.mesh.faces.resize(mesh_.n_faces(), 3);
    for (const auto f : mesh_.faces()) {
        int c = 0;
        for (const auto v : f.vertices()) result.mesh.faces(f.idx(), c++) = v.idx();
        result.origin.push_back(mesh_.data(f).origin);
    }
    result.on_origin = on_origin_;
    if (!queue_.empty()) result.longest_left = mesh_.calc_edge_length(queue_.top().edge);
    return result;
}

}  // namespace

Bisection bisect_longest_edges(const TriangleMesh& mesh, double target_length, int max_vertices) {
    Bisector bisector(mesh, target_length);
    bisector.run(max_vertices);
    return bisector.result();
}

}  // namespace varimap
