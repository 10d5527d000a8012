#include "varimap/mesh/thin_faces.h"

#include <algorithm>
#include <cmath>

#include "varimap/core/index_set.h"
#include "varimap/mesh/private/half_edge_mesh.h"

namespace varimap {
namespace {

using OpenMesh::SmartFaceHandle;
using OpenMesh::SmartHalfedgeHandle;

class Repairer {
  public:
    Repairer(const TriangleMesh& mesh, double thinnest);
    void run();
    ThinFaceRemoval result(const TriangleMesh& before) const;

  private:
    Vec3 point(OpenMesh::VertexHandle v) const { return varimap::point(mesh_, v); }
    double thinness_of(SmartFaceHandle f) const;
    bool remove(SmartFaceHandle f);
    bool collapse(SmartHalfedgeHandle side);
    bool keeps_faces_upright(SmartHalfedgeHandle collapsed) const;
    bool turn(SmartHalfedgeHandle side);
    int present_vertex(int v) const;

    HalfEdgeMesh mesh_;
    double thinnest_;
    std::vector<int> vertex_, origin_;  ///< a removed vertex: the one it was collapsed into
    int collapsed_ = 0, turned_ = 0;
};

Repairer::Repairer(const TriangleMesh& mesh, double thinnest)
    : mesh_(half_edges(mesh)),
      thinnest_(thinnest),
      vertex_(all_indices(mesh.vertex_count())),
      origin_(all_indices(mesh.face_count())) {}

double Repairer::thinness_of(SmartFaceHandle f) const {
    const auto side = f.halfedge();
    return thinness(point(side.from()), point(side.to()), point(side.next().to()));
}

/// Removing one face can make another removable. Clusters of a hundred layers do not occur.
void Repairer::run() {
    bool progress = true;
    for (int pass = 0; pass < 100 && progress; ++pass) {
        progress = false;
        for (int f = 0; f < int(mesh_.n_faces()); ++f) {
            const auto face = OpenMesh::make_smart(mesh_.face_handle(unsigned(f)), mesh_);
            if (!face.deleted() && thinness_of(face) < thinnest_) progress = remove(face) || progress;
        }
    }
}

bool Repairer::remove(SmartFaceHandle f) {
    std::array<SmartHalfedgeHandle, 3> side{f.halfedge(), f.halfedge().next(), f.halfedge().prev()};
    const auto length = [&](SmartHalfedgeHandle h) { return mesh_.calc_edge_length(h); };
    std::sort(side.begin(), side.end(), [&](auto a, auto b) { return length(a) < length(b); });
    if (length(side[0]) <= 10 * thinnest_ * length(side[2])) return collapse(side[0]);
    return turn(side[2]);
}

/// Collapses a side into its lower vertex, or, where that would turn other faces over, into the higher one.
bool Repairer::collapse(SmartHalfedgeHandle side) {
    if (side.from().idx() < side.to().idx()) side = side.opp();
    for (const auto way : {side, side.opp()}) {
        if (!mesh_.is_collapse_ok(way) || !keeps_faces_upright(way)) continue;
        vertex_[way.from().idx()] = way.to().idx();
        mesh_.collapse(way);
        ++collapsed_;
        return true;
    }
    return false;
}

/// No face that has an area turns over or becomes thin when the side's start moves to its end.
bool Repairer::keeps_faces_upright(SmartHalfedgeHandle collapsed) const {
    for (const auto f : collapsed.from().faces()) {
        if (f == collapsed.face() || f == collapsed.opp().face() || thinness_of(f) < thinnest_) continue;
        std::array<Vec3, 3> before, after;
        int c = 0;
        for (const auto v : f.vertices()) {
            before[c] = point(v);
            after[c++] = point(v == collapsed.from() ? collapsed.to() : v);
        }
        const Vec3 normal = (before[1] - before[0]).cross(before[2] - before[0]);
        if (!(normal.dot((after[1] - after[0]).cross(after[2] - after[0])) > 0)) return false;
        if (thinness(after[0], after[1], after[2]) < thinnest_) return false;
    }
    return true;
}

/// Turns a side where the two faces are then less thin; they lie on what was the face behind it.
bool Repairer::turn(SmartHalfedgeHandle side) {
    if (side.opp().is_boundary() || !mesh_.is_flip_ok(side.edge())) return false;
    const auto face = side.face(), behind = side.opp().face();
    const Vec3 a = point(side.from()), b = point(side.to()), here = point(side.next().to()),
               there = point(side.opp().next().to());
    const double before = std::min(thinness_of(face), thinness_of(behind));
    if (!(std::min(thinness(a, there, here), thinness(there, b, here)) > before)) return false;
    mesh_.flip(side.edge());
    origin_[face.idx()] = origin_[behind.idx()];
    ++turned_;
    return true;
}

int Repairer::present_vertex(int v) const {
    while (vertex_[v] != v) v = vertex_[v];
    return v;
}

ThinFaceRemoval Repairer::result(const TriangleMesh& before) const {
    ThinFaceRemoval result;
    result.collapsed = collapsed_;
    result.turned = turned_;
    std::vector<int> number(vertex_.size());
    int count = 0;
    for (std::size_t v = 0; v < vertex_.size(); ++v) number[v] = vertex_[v] == int(v) ? count++ : -1;
    result.mesh.vertices.resize(count, 3);
    for (int v = 0; v < int(vertex_.size()); ++v) {
        if (number[v] >= 0) result.mesh.vertices.row(number[v]) = before.vertices.row(v);
        result.vertex.push_back(number[present_vertex(v)]);
    }
    std::vector<int> corners;
    for (const auto f : mesh_.faces()) {  // without the deleted ones
        for (const auto v : f.vertices()) corners.push_back(number[v.idx()]);
        result.origin.push_back(origin_[f.idx()]);
    }
    result.mesh.faces = Faces::Map(corners.data(), Eigen::Index(result.origin.size()), 3);
    return result;
}

}  // namespace

double thinness(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    return longest > 0 ? (b - a).cross(c - a).norm() / longest : 0;
}

double thinness(const TriangleMesh& mesh, int f) {
    return thinness(mesh.vertex(mesh.faces(f, 0)), mesh.vertex(mesh.faces(f, 1)),
                    mesh.vertex(mesh.faces(f, 2)));
}

ThinFaceRemoval remove_thin_faces(const TriangleMesh& mesh, double thinnest) {
    int thin = 0;
    for (int f = 0; f < mesh.face_count(); ++f) thin += thinness(mesh, f) < thinnest;
    if (thin > 0) {
        Repairer repairer(mesh, thinnest);
        repairer.run();
        return repairer.result(mesh);
    }
    return {mesh, all_indices(mesh.vertex_count()), all_indices(mesh.face_count())};
}

}  // namespace varimap
