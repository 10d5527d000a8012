#include "varimap/verification/verification.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "varimap/core/parallel.h"
#include "varimap/mesh/closest_point.h"
#include "varimap/mesh/topology.h"
#include "varimap/verification/map_degree.h"

namespace varimap {

namespace {

const std::array<Vec3, 7> inner_points{Vec3(1, 1, 1) / 3,  Vec3(.8, .1, .1),    Vec3(.1, .8, .1),
                                       Vec3(.1, .1, .8),   Vec3(.06, .47, .47), Vec3(.47, .06, .47),
                                       Vec3(.47, .47, .06)};

using std::numbers::pi;
using Corners = std::array<Vec3, 3>;

Corners corners_of(const TriangleMesh& mesh, int f) {
    return {mesh.vertex(mesh.faces(f, 0)), mesh.vertex(mesh.faces(f, 1)), mesh.vertex(mesh.faces(f, 2))};
}

/// Whether twice the area is no more than what rounding leaves of a segment or a point; `scale` is an area.
bool is_degenerate(const Corners& p, double scale) {
    const double longest =
        std::max({(p[1] - p[0]).squaredNorm(), (p[2] - p[1]).squaredNorm(), (p[0] - p[2]).squaredNorm()});
    return !((p[1] - p[0]).cross(p[2] - p[0]).norm() > 1e-11 * longest + 1e-15 * scale);
}

/// Positions of the images; where there is none, some place on the target.
Points images(const PointMap& map, const TriangleMesh& target) {
    Points points = target.vertices.row(target.faces(0, 0)).replicate(Eigen::Index(map.size()), 1);
    for (std::size_t v = 0; v < map.size(); ++v)
        if (map[v].face >= 0) points.row(Eigen::Index(v)) = position(target, map[v]).transpose();
    return points;
}

double angle(const Vec3& a, const Vec3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Angle from a to b as seen along `axis` (a unit vector or 0), counter-clockwise positive.
double seen_angle(const Vec3& a, const Vec3& b, const Vec3& axis) {
    return std::atan2(axis.dot(a.cross(b)), a.dot(b) - a.dot(axis) * b.dot(axis));
}

/// Per vertex: sum of the angles of its faces.
std::vector<double> angles_around_vertices(const TriangleMesh& mesh) {
    std::vector<double> sums(std::size_t(mesh.vertex_count()), 0);
    for (int f = 0; f < mesh.face_count(); ++f) {
        const Corners p = corners_of(mesh, f);
        for (std::size_t k = 0; k < 3; ++k)
            sums[std::size_t(mesh.faces(f, int(k)))] += angle(p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
    }
    return sums;
}

/// The vertex a surface point coincides with; -1: none.
int vertex_at(const TriangleMesh& mesh, const SurfacePoint& point) {
    int k = 0;
    return point.face >= 0 && point.barycentric.maxCoeff(&k) > 1 - 1e-9 ? mesh.faces(point.face, k) : -1;
}

enum class Verdict : char { left_out, degenerate, reversed, upright };

class Judge {
  public:
    Judge(const PointMap& map, const TriangleMesh& source, const TriangleMesh& target)
        : map_(map),
          source_(source),
          target_(target),
          image_{images(map, target), source.faces},
          closest_(target),
          source_area_(surface_area(source)),
          target_area_(surface_area(target)),
          verdict_(std::size_t(source.face_count())),
          side_(Points::Zero(source.face_count(), 3)) {
        parallel_for_each_index(source.face_count(), 64, [&](int f) { verdict_[std::size_t(f)] = judge(f); });
    }
    Verification result() const;

  private:
    Verdict judge(int f);
    bool has_images(int f) const;
    void add_areas(Verification& found) const;
    void find_branches(Verification& found) const;
    double sign(int f) const { return verdict_[std::size_t(f)] == Verdict::reversed ? -1 : 1; }
    bool is_judged(int f) const { return verdict_[std::size_t(f)] >= Verdict::reversed; }

    const PointMap& map_;
    const TriangleMesh &source_, &target_;
    TriangleMesh image_;  ///< the image triangles
    ClosestPoint closest_;
    double source_area_, target_area_;
    std::vector<Verdict> verdict_;
    Points side_;  ///< per face: sum of the target's normals below its image triangle; 0 where not judged
};

bool Judge::has_images(int f) const {
    for (int k = 0; k < 3; ++k)
        if (map_[std::size_t(source_.faces(f, k))].face < 0) return false;
    return true;
}

Verdict Judge::judge(int f) {
    if (!has_images(f)) return Verdict::left_out;
    if (is_degenerate(corners_of(source_, f), source_area_)) return Verdict::degenerate;
    const Corners p = corners_of(image_, f);
    if (is_degenerate(p, target_area_)) return Verdict::reversed;
    Vec3 m = Vec3::Zero();
    int face = -1;
    for (const Vec3& b : inner_points) {
        face = closest_(b[0] * p[0] + b[1] * p[1] + b[2] * p[2], face).point.face;
        const Corners q = corners_of(target_, face);
        m += (q[1] - q[0]).cross(q[2] - q[0]).stableNormalized();
    }
    side_.row(f) = m.transpose();
    return (p[1] - p[0]).cross(p[2] - p[0]).dot(m) > 0 ? Verdict::upright : Verdict::reversed;
}

void Judge::add_areas(Verification& found) const {
    double judged = 0, reversed = 0, signed_image = 0;
    const auto area = [](const Corners& p) { return (p[1] - p[0]).cross(p[2] - p[0]).norm() / 2; };
    for (int f = 0; f < source_.face_count(); ++f) {
        found.left_out_count += verdict_[std::size_t(f)] == Verdict::left_out;
        if (!is_judged(f)) continue;
        judged += area(corners_of(source_, f));
        signed_image += sign(f) * area(corners_of(image_, f));
        if (verdict_[std::size_t(f)] != Verdict::reversed) continue;
        found.reversed_faces.push_back(f);
        reversed += area(corners_of(source_, f));
    }
    if (judged > 0) found.reversed_area_percent = 100 * reversed / judged;
    if (target_area_ > 0) found.signed_area_ratio = signed_image / target_area_;
}

void Judge::find_branches(Verification& found) const {
    const auto count = std::size_t(source_.vertex_count());
    Points axis = Points::Zero(source_.vertex_count(), 3);
    for (int f = 0; f < source_.face_count(); ++f)
        for (int k = 0; k < 3; ++k) axis.row(source_.faces(f, k)) += side_.row(f);
    axis.rowwise().normalize();
    std::vector<double> unfolded(count, 0), seen(count, 0);
    for (int f = 0; f < source_.face_count(); ++f) {
        if (verdict_[std::size_t(f)] == Verdict::left_out) continue;
        const Corners p = corners_of(image_, f);
        for (std::size_t k = 0; k < 3; ++k) {
            const int v = source_.faces(f, int(k));
            const Vec3 right = p[(k + 1) % 3] - p[k], left = p[(k + 2) % 3] - p[k];
            unfolded[std::size_t(v)] += sign(f) * angle(right, left);
            seen[std::size_t(v)] += seen_angle(right, left, axis.row(v));
        }
    }
    const std::vector<double> full = angles_around_vertices(target_);
    for (std::size_t v = 0; v < count; ++v) {
        const int vertex = vertex_at(target_, map_[v]);
        const double once = vertex >= 0 ? full[std::size_t(vertex)] : 2 * pi;
        if (std::abs(seen[v]) >= 3 * pi && unfolded[v] * std::copysign(1., seen[v]) >= 1.25 * once)
            found.branch_vertices.push_back(int(v));
    }
}

Verification Judge::result() const {
    Verification found;
    add_areas(found);
    find_branches(found);
    if (found.left_out_count == 0 && is_closed(source_) && is_closed(target_))
        found.degree = map_degree(image_, target_);
    return found;
}

}  // namespace

Verification verify_map(const PointMap& map, const TriangleMesh& source, const TriangleMesh& target) {
    return Judge(map, source, target).result();
}

}  // namespace varimap
