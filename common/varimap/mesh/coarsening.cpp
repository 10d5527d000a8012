#include "varimap/mesh/coarsening.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>

#include "varimap/core/plane.h"
#include "varimap/mesh/face_geometry.h"
#include "varimap/mesh/private/half_edge_mesh.h"
#include "varimap/mesh/topology.h"

namespace varimap {
namespace {

using OpenMesh::SmartHalfedgeHandle;
using OpenMesh::VertexHandle;
/// Share of the squared way times the area in a collapse's cost. Without it, flat places keep hardly a
/// vertex.
constexpr double evenness = 0.05;
/// Weight of the planes that stand upright on the boundary, which hold it in place.
constexpr double boundary_weight = 10;
/// Of a new face's normal and the mean normal around the vertex that goes: the least cosine.
constexpr double least_cosine = 0.3;
/// 4 sqrt(3) area / sum of squared sides, 1 if equilateral: least of a new face, unless the old ones were
/// worse.
constexpr double least_quality = 0.25;
/// Where all faces are equally thin, as marching cubes make them along planes, no vertex can go by that. Half
/// as good ones are allowed there once others cost so many times as much: else such places would keep their
/// vertices, and limbs lose theirs.
constexpr double patience = 100;
/// Of a new face in the plane: least share of the mean of the old ones' areas.
constexpr double least_share = 1e-3;
constexpr int most_neighbours = 11;
constexpr double no_entry = std::numeric_limits<double>::quiet_NaN();

double quality(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double sides = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
    return sides > 0 ? 2 * std::numbers::sqrt3 * (b - a).cross(c - a).norm() / sides : 0;
}

/// Sum of weighted squared distances to planes, of points relative to a vertex: far from the origin digits
/// would be lost.
struct Quadric {
    Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
    Vec3 b = Vec3::Zero();
    double c = 0, area = 0;

    void add_plane_through_vertex(const Vec3& normal, double weight) {
        A += weight * normal * normal.transpose();
    }
    double operator()(const Vec3& x) const { return x.dot(A * x) + 2 * b.dot(x) + c; }
    /// Adds one that is relative to another vertex, which lies at `way` from this one.
    void add(const Quadric& other, const Vec3& way) {
        A += other.A;
        b += other.b - other.A * way;
        c += other(-way);
        area += other.area;
    }
};

/// The faces around a vertex, laid into the plane with the vertex at the origin.
struct Disc {
    VertexHandle centre;
    std::vector<SmartHalfedgeHandle> spokes;  ///< counter-clockwise; face i lies between spokes i and i + 1
    std::vector<Vec2> at;                     ///< the spokes' ends
    bool closed = true;                       ///< the centre is inside, not on the boundary

    int size() const { return int(spokes.size()); }
    int faces() const { return closed ? size() : size() - 1; }
    int next(int i) const { return i + 1 == size() ? 0 : i + 1; }
};

struct Entry {
    double cost;
    int vertex;
    bool loose = false;  ///< half as good faces are allowed
    /// The cheapest first, among equals the lowest vertex.
    bool operator<(const Entry& other) const {
        return cost != other.cost ? cost > other.cost : vertex > other.vertex;
    }
};

/// To about six digits: rounding errors of a moved copy do not change the order.
double rounded(double cost) {
    int exponent;
    const double mantissa = std::frexp(cost, &exponent);
    return std::ldexp(std::round(mantissa * 0x1p20), exponent - 20);
}

class Coarsener {
  public:
    Coarsener(const TriangleMesh& mesh, const PointMap& points);
    /// `most_lost`: an area.
    void reduce_to(int vertices, int vertices_if_thin, double most_lost);
    Coarsening result(const TriangleMesh& before) const;

  private:
    Vec3 position(VertexHandle v) const { return point(mesh_, v); }
    void add_quadrics();
    void enqueue(VertexHandle v);
    double cost(SmartHalfedgeHandle collapsed) const;
    void measure(SmartHalfedgeHandle h) { cost_[std::size_t(h.idx())] = cost(h); }
    double measured(SmartHalfedgeHandle h) const { return cost_[std::size_t(h.idx())]; }
    Disc lay_out(VertexHandle v) const;
    Vec3 mean_normal(const Disc& disc) const;
    double worst_quality(const Disc& disc) const;
    int cheapest_target(const Disc& disc, bool loose);
    bool is_allowed(const Disc& disc, int target, double least);
    bool leaves_enough_faces(const Disc& disc, int target) const;
    bool is_upright(const Disc& disc, int target, double least) const;
    void collapse(const Disc& disc, int target);
    double area_lost(const Disc& disc, int target) const;
    void move_points(const Disc& disc, int target);
    void put(int point, int face, const Vec3& barycentric);

    HalfEdgeMesh mesh_;
    Faces faces_;  ///< corners stay at their places when one is exchanged
    std::vector<Quadric> quadric_;
    std::vector<double> cost_;    ///< per half-edge; a collapse changes those of its target alone
    std::vector<double> queued_;  ///< per vertex: the cost of the entry that counts; NaN: none does
    std::priority_queue<Entry> queue_;
    int left_;
    double lost_ = 0;                ///< area
    PointMap on_mesh_;               ///< of vertices that are gone; then of the further points
    std::vector<int> first_, next_;  ///< per face, per point: lists of the points on each face
};

Coarsener::Coarsener(const TriangleMesh& mesh, const PointMap& points)
    : mesh_(half_edges(mesh)),
      faces_(mesh.faces),
      quadric_(std::size_t(mesh.vertex_count())),
      queued_(std::size_t(mesh.vertex_count()), no_entry),
      left_(mesh.vertex_count()),
      on_mesh_(std::size_t(mesh.vertex_count()) + points.size()),
      first_(std::size_t(mesh.face_count()), -1),
      next_(on_mesh_.size(), -1) {
    for (std::size_t i = 0; i < points.size(); ++i)
        put(mesh.vertex_count() + int(i), points[i].face, points[i].barycentric);
    add_quadrics();
    cost_.resize(mesh_.n_halfedges());
    for (const auto h : mesh_.halfedges()) measure(h);
    for (const auto v : mesh_.vertices()) enqueue(v);
}

void Coarsener::add_quadrics() {
    for (const auto f : mesh_.faces()) {
        const auto side = f.halfedge();
        const Vec3 a = position(side.from()), b = position(side.to()), c = position(side.next().to());
        const Vec3 normal = (b - a).cross(c - a);
        const double area = normal.norm() / 2;
        Quadric plane;
        plane.area = area / 3;
        if (area > 0) plane.add_plane_through_vertex(normal / (2 * area), area / 3);
        for (const auto v : f.vertices()) quadric_[std::size_t(v.idx())].add(plane, Vec3::Zero());
        for (const auto h : f.halfedges()) {
            if (!h.opp().is_boundary() || !(area > 0)) continue;
            const Vec3 along = position(h.to()) - position(h.from());
            Quadric upright;
            upright.add_plane_through_vertex(along.cross(normal).normalized(),
                                             boundary_weight * along.squaredNorm());
            for (const auto v : {h.from(), h.to()}) quadric_[std::size_t(v.idx())].add(upright, Vec3::Zero());
        }
    }
}

double Coarsener::cost(SmartHalfedgeHandle collapsed) const {
    const Quadric &here = quadric_[std::size_t(collapsed.from().idx())],
                  &there = quadric_[std::size_t(collapsed.to().idx())];
    const Vec3 way = position(collapsed.to()) - position(collapsed.from());
    return std::max(0.0, here(way) + there.c) + evenness * (here.area + there.area) * way.squaredNorm();
}

/// On a boundary a vertex goes only along it.
bool may_collapse(SmartHalfedgeHandle h) {
    return !h.from().is_boundary() || h.edge().is_boundary();
}

void Coarsener::enqueue(VertexHandle v) {
    double least = std::numeric_limits<double>::infinity();
    for (const auto h : mesh_.voh_range(v))
        if (measured(h) < least && may_collapse(h)) least = measured(h);
    const double cost = std::isfinite(least) ? rounded(least) : no_entry;
    double& queued = queued_[std::size_t(v.idx())];
    if (cost == queued) return;
    queued = cost;
    if (std::isfinite(cost)) queue_.push({cost, v.idx()});
}

Disc Coarsener::lay_out(VertexHandle v) const {
    Disc disc;
    disc.centre = v;
    disc.closed = !mesh_.is_boundary(v);
    // From a boundary's own half-edge, which OpenMesh puts first, clockwise is through the faces.
    for (const auto h : mesh_.voh_cw_range(v)) disc.spokes.push_back(h);
    std::reverse(disc.spokes.begin(), disc.spokes.end());
    const Vec3 centre = position(v);
    std::vector<double> angle{0};
    for (int i = 0; i < disc.faces(); ++i) {
        const Vec3 a = position(disc.spokes[std::size_t(i)].to()) - centre,
                   b = position(disc.spokes[std::size_t(disc.next(i))].to()) - centre;
        angle.push_back(angle.back() + angle_between(a, b));
    }
    const double scale = (disc.closed ? 2 : 1) * std::numbers::pi / angle.back();
    for (int i = 0; i < disc.size(); ++i) {
        const double turn = scale * angle[std::size_t(i)];
        disc.at.push_back((position(disc.spokes[std::size_t(i)].to()) - centre).norm() *
                          Vec2(std::cos(turn), std::sin(turn)));
    }
    return disc;
}

Vec3 Coarsener::mean_normal(const Disc& disc) const {
    const Vec3 centre = position(disc.centre);
    Vec3 sum = Vec3::Zero();
    for (int i = 0; i < disc.faces(); ++i)
        sum += (position(disc.spokes[std::size_t(i)].to()) - centre)
                   .cross(position(disc.spokes[std::size_t(disc.next(i))].to()) - centre);
    return sum.normalized();
}

double Coarsener::worst_quality(const Disc& disc) const {
    double worst = 1;
    for (int i = 0; i < disc.faces(); ++i)
        worst = std::min(worst, quality(position(disc.centre), position(disc.spokes[std::size_t(i)].to()),
                                        position(disc.spokes[std::size_t(disc.next(i))].to())));
    return worst;
}

/// In space: no new face stands on edge, or has less than the least quality.
bool Coarsener::is_upright(const Disc& disc, int target, double least) const {
    const Vec3 up = mean_normal(disc), apex = position(disc.spokes[std::size_t(target)].to());
    for (int i = 0; i < disc.faces(); ++i) {
        if (i == target || disc.next(i) == target) continue;
        const Vec3 a = position(disc.spokes[std::size_t(i)].to()),
                   b = position(disc.spokes[std::size_t(disc.next(i))].to());
        const Vec3 normal = (a - apex).cross(b - apex);
        if (!(normal.dot(up) > least_cosine * normal.norm()) || quality(apex, a, b) < least) return false;
    }
    return true;
}

/// The two vertices beside the target lose a face; none may be left between two faces that lie on each other.
bool Coarsener::leaves_enough_faces(const Disc& disc, int target) const {
    const auto has_enough = [&](int i) {
        const VertexHandle v = disc.spokes[std::size_t(i)].to();
        return int(mesh_.valence(v)) > (mesh_.is_boundary(v) ? 2 : 3);
    };
    const bool first = target == 0, last = target + 1 == disc.size();
    return ((first && !disc.closed) || has_enough(first ? disc.size() - 1 : target - 1)) &&
           ((last && !disc.closed) || has_enough(disc.next(target)));
}

bool Coarsener::is_allowed(const Disc& disc, int target, double least) {
    const auto collapsed = disc.spokes[std::size_t(target)];
    if (!may_collapse(collapsed) || disc.faces() < 2) return false;  // a face must be left to its points
    if (int(mesh_.valence(collapsed.to())) + disc.size() - 4 > most_neighbours) return false;
    const Vec2 apex = disc.at[std::size_t(target)];
    double area = 0;
    for (int i = 0; i < disc.faces(); ++i)
        area += cross(disc.at[std::size_t(i)], disc.at[std::size_t(disc.next(i))]);
    for (int i = 0; i < disc.faces(); ++i)
        if (i != target && disc.next(i) != target &&
            !(cross(disc.at[std::size_t(i)] - apex, disc.at[std::size_t(disc.next(i))] - apex) >
              least_share * area / disc.faces()))
            return false;
    return leaves_enough_faces(disc, target) && is_upright(disc, target, least) &&
           mesh_.is_collapse_ok(collapsed);
}

void Coarsener::put(int point, int face, const Vec3& barycentric) {
    on_mesh_[std::size_t(point)] = {face, barycentric};
    next_[std::size_t(point)] = first_[std::size_t(face)];
    first_[std::size_t(face)] = point;
}

/// The faces that take the place of those around a vertex that goes, in the plane.
class NewFaces {
  public:
    NewFaces(const Disc& disc, int target) : disc_(disc), target_(target) {}

    /// In which face a point lies (the one between spokes i and i + 1), and its coordinates: of the target,
    /// and of the ends of these spokes.
    std::pair<int, Vec3> locate(const Vec2& x) const {
        int best = -1;
        Vec3 at = Vec3::Zero();
        for (int i = 0; i < disc_.faces(); ++i) {
            if (i == target_ || disc_.next(i) == target_) continue;
            const Vec3 b = coordinates(i, x);
            if (best < 0 || b.minCoeff() > at.minCoeff()) best = i, at = b;
            if (at.minCoeff() >= 0) break;
        }
        at = at.cwiseMax(0);
        return {best, at / at.sum()};
    }

  private:
    Vec3 coordinates(int i, const Vec2& x) const {
        const Vec2 apex = disc_.at[std::size_t(target_)], a = disc_.at[std::size_t(i)],
                   b = disc_.at[std::size_t(disc_.next(i))];
        return Vec3(cross(a - x, b - x), cross(b - x, apex - x), cross(apex - x, a - x)) /
               cross(a - apex, b - apex);
    }
    const Disc& disc_;
    int target_;
};

/// Moves what lies on the faces around the centre, and the centre, to the faces that will take their place.
void Coarsener::move_points(const Disc& disc, int target) {
    std::vector<std::pair<int, Vec2>> points{{disc.centre.idx(), Vec2::Zero()}};
    for (int i = 0; i < disc.faces(); ++i) {
        const int face = disc.spokes[std::size_t(i)].face().idx();
        for (int k = 0; k < 3; ++k) {
            if (faces_(face, k) != disc.centre.idx()) continue;
            for (int p = first_[std::size_t(face)]; p >= 0; p = next_[std::size_t(p)]) {
                const Vec3& b = on_mesh_[std::size_t(p)].barycentric;
                points.emplace_back(p, b[(k + 1) % 3] * disc.at[std::size_t(i)] +
                                           b[(k + 2) % 3] * disc.at[std::size_t(disc.next(i))]);
            }
        }
        first_[std::size_t(face)] = -1;
    }
    const NewFaces faces(disc, target);
    for (const auto& [vertex, x] : points) {
        const auto [i, weights] = faces.locate(x);
        const int face = disc.spokes[std::size_t(i)].face().idx();
        Vec3 barycentric;
        for (int k = 0; k < 3; ++k) {
            const int corner = faces_(face, k);
            barycentric[k] = corner == disc.centre.idx()                        ? weights[0]
                             : corner == disc.spokes[std::size_t(i)].to().idx() ? weights[1]
                                                                                : weights[2];
        }
        put(vertex, face, barycentric);
    }
}

/// By the collapse, of the faces around the vertex that goes.
double Coarsener::area_lost(const Disc& disc, int target) const {
    const auto corner = [&](int i) { return position(disc.spokes[std::size_t(i)].to()); };
    const auto twice_area = [](const Vec3& a, const Vec3& b, const Vec3& c) {
        return (b - a).cross(c - a).norm();
    };
    const Vec3 centre = position(disc.centre), apex = corner(target);
    double twice = 0;
    for (int i = 0; i < disc.faces(); ++i) {
        const Vec3 a = corner(i), b = corner(disc.next(i));
        twice += twice_area(centre, a, b);
        if (i != target && disc.next(i) != target) twice -= twice_area(apex, a, b);
    }
    return twice / 2;
}

void Coarsener::collapse(const Disc& disc, int target) {
    lost_ += area_lost(disc, target);
    move_points(disc, target);
    const auto collapsed = disc.spokes[std::size_t(target)];
    const VertexHandle apex = collapsed.to();
    for (int i = 0; i < disc.faces(); ++i)
        for (int k = 0; k < 3; ++k) {
            int& corner = faces_(disc.spokes[std::size_t(i)].face().idx(), k);
            if (corner == disc.centre.idx()) corner = apex.idx();
        }
    quadric_[std::size_t(apex.idx())].add(quadric_[std::size_t(disc.centre.idx())],
                                          position(disc.centre) - position(apex));
    mesh_.collapse(collapsed);
    --left_;
    for (const auto h : mesh_.voh_range(apex)) {
        measure(h);
        measure(h.opp());
    }
    enqueue(apex);
    for (const auto v : mesh_.vv_range(apex)) enqueue(v);
}

/// The spoke along which the centre goes at the least cost; -1 where it may go along none.
int Coarsener::cheapest_target(const Disc& disc, bool loose) {
    int best = -1;
    const double least_allowed = std::min(least_quality, worst_quality(disc) / (loose ? 2 : 1));
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < disc.size(); ++i) {
        const double here = rounded(measured(disc.spokes[std::size_t(i)]));
        if (here < least && is_allowed(disc, i, least_allowed)) least = here, best = i;
    }
    return best;
}

void Coarsener::reduce_to(int vertices, int vertices_if_thin, double most_lost) {
    while (left_ > vertices && !queue_.empty()) {
        if (left_ <= vertices_if_thin && lost_ > most_lost) break;
        const Entry entry = queue_.top();
        queue_.pop();
        const VertexHandle v = mesh_.vertex_handle(unsigned(entry.vertex));
        double& queued = queued_[std::size_t(entry.vertex)];
        if (mesh_.status(v).deleted() || entry.cost != queued) continue;
        queued = no_entry;
        const Disc disc = lay_out(v);
        // One that cannot go now is asked again when its surroundings change, or all others cost far more.
        if (const int target = cheapest_target(disc, entry.loose); target >= 0) {
            collapse(disc, target);
        } else if (!entry.loose) {
            queued = patience * entry.cost;
            queue_.push({queued, entry.vertex, true});
        }
    }
}

Coarsening Coarsener::result(const TriangleMesh& before) const {
    Coarsening result;
    std::vector<int> number(std::size_t(before.vertex_count()), -1),
        face_number(std::size_t(before.face_count()), -1);
    for (const auto v : mesh_.vertices()) {  // without the deleted ones
        number[std::size_t(v.idx())] = int(result.vertex.size());
        result.vertex.push_back(v.idx());
    }
    result.mesh.vertices = before.vertices(result.vertex, Eigen::all);
    std::vector<int> left;
    for (const auto f : mesh_.faces()) {
        face_number[std::size_t(f.idx())] = int(left.size());
        left.push_back(f.idx());
    }
    result.mesh.faces = faces_(left, Eigen::all).unaryExpr([&](int v) { return number[std::size_t(v)]; });
    result.on_mesh = on_mesh_;
    for (SurfacePoint& point : result.on_mesh)
        if (point.face >= 0) point.face = face_number[std::size_t(point.face)];
    const PointMap at_vertices = points_at_vertices(result.mesh);
    for (std::size_t v = 0; v < result.vertex.size(); ++v)
        result.on_mesh[std::size_t(result.vertex[v])] = at_vertices[v];
    const auto further = result.on_mesh.begin() + before.vertex_count();
    result.points.assign(further, result.on_mesh.end());
    result.on_mesh.erase(further, result.on_mesh.end());
    return result;
}

}  // namespace

Coarsening coarsen(const TriangleMesh& mesh, int vertices, const PointMap& points, const ThinParts& thin) {
    Coarsener coarsener(mesh, points);
    coarsener.reduce_to(vertices, thin.vertices, thin.most_lost * surface_area(mesh));
    return coarsener.result(mesh);
}

}  // namespace varimap
