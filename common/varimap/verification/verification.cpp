#include "varimap/verification/verification.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "varimap/core/parallel.h"
#include "varimap/geodesics/log_map.h"
#include "varimap/mesh/closest_point.h"
#include "varimap/mesh/topology.h"
#include "varimap/verification/map_degree.h"

namespace varimap {

namespace {

const std::array<Vec3, 7> inner_points{Vec3(1, 1, 1) / 3,  Vec3(.8, .1, .1),    Vec3(.1, .8, .1),
                                       Vec3(.1, .1, .8),   Vec3(.06, .47, .47), Vec3(.47, .06, .47),
                                       Vec3(.47, .47, .06)};

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
          edges_(find_edges(source)),
          seen_(look_around()),
          verdict_(std::size_t(source.face_count())),
          cuts_(std::size_t(source.face_count()), 0) {
        parallel_for_each_index(source.face_count(), 64, [&](int f) {
            verdict_[std::size_t(f)] = judge(f);
            cuts_[std::size_t(f)] = is_judged(f) && cuts_through(f);
        });
    }
    Verification result() const;

  private:
    std::vector<std::pair<Vec2, Vec2>> look_around() const;
    Vec2 seen(int f, int from, int to) const;
    double turn(int f, int k) const;
    Verdict judge(int f) const;
    bool cuts_through(int f) const;
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
    Edges edges_;  ///< of the source
    std::vector<std::pair<Vec2, Vec2>>
        seen_;  ///< per edge: higher vertex from the lower, lower from the higher
    std::vector<Verdict> verdict_;
    std::vector<char> cuts_;
};

bool Judge::has_images(int f) const {
    for (int k = 0; k < 3; ++k)
        if (map_[std::size_t(source_.faces(f, k))].face < 0) return false;
    return true;
}

std::vector<std::pair<Vec2, Vec2>> Judge::look_around() const {
    const LogMap log_map(target_);
    std::vector<std::pair<Vec2, Vec2>> seen(edges_.vertices.size(), {Vec2::Zero(), Vec2::Zero()});
    parallel_for_each_index(edges_.size(), 64, [&](int e) {
        const auto [low, high] = edges_.vertices[std::size_t(e)];
        const SurfacePoint &a = map_[std::size_t(low)], &b = map_[std::size_t(high)];
        if (a.face >= 0 && b.face >= 0) seen[std::size_t(e)] = log_map(a, b);
    });
    return seen;
}

/// The image of a face's corner as seen from that of another.
Vec2 Judge::seen(int f, int from, int to) const {
    const int half_edge = 3 * f + ((from + 1) % 3 == to ? from : to);
    const auto& [of_higher, of_lower] = seen_[std::size_t(edges_.of_half_edge[std::size_t(half_edge)])];
    return source_.faces(f, from) < source_.faces(f, to) ? of_higher : of_lower;
}

double cross(const Vec2& a, const Vec2& b) {
    return a.x() * b.y() - a.y() * b.x();
}

/// Angle from the one neighbour's image to the other's, as seen from that of corner k.
double Judge::turn(int f, int k) const {
    const Vec2 right = seen(f, k, (k + 1) % 3), left = seen(f, k, (k + 2) % 3);
    return std::atan2(cross(right, left), right.dot(left));
}

Verdict Judge::judge(int f) const {
    if (!has_images(f)) return Verdict::left_out;
    if (is_degenerate(corners_of(source_, f), source_area_)) return Verdict::degenerate;
    double sum = 0, longest = 0;
    for (int k = 0; k < 3; ++k) {
        const Vec2 right = seen(f, k, (k + 1) % 3);
        sum += cross(right, seen(f, k, (k + 2) % 3));
        longest = std::max(longest, right.squaredNorm());
    }
    return sum > 1e-11 * longest + 1e-15 * target_area_ ? Verdict::upright : Verdict::reversed;
}

bool Judge::cuts_through(int f) const {
    const Corners p = corners_of(image_, f);
    const Vec3 normal = (p[1] - p[0]).cross(p[2] - p[0]) * sign(f);
    Vec3 m = Vec3::Zero();
    std::size_t left = inner_points.size();
    int face = map_[std::size_t(source_.faces(f, 0))].face;
    for (const Vec3& b : inner_points) {
        face = closest_(b[0] * p[0] + b[1] * p[1] + b[2] * p[2], face).point.face;
        const Corners q = corners_of(target_, face);
        m += (q[1] - q[0]).cross(q[2] - q[0]).stableNormalized();
        // Each of those left adds a vector of length 1 at most.
        if (normal.dot(m) > double(--left) * (1 + 1e-9) * normal.norm()) return false;
    }
    return !(normal.dot(m) > 0);
}

void Judge::add_areas(Verification& found) const {
    double judged = 0, reversed = 0, signed_image = 0;
    const auto area = [](const Corners& p) { return (p[1] - p[0]).cross(p[2] - p[0]).norm() / 2; };
    for (int f = 0; f < source_.face_count(); ++f) {
        found.left_out_count += verdict_[std::size_t(f)] == Verdict::left_out;
        if (!is_judged(f)) continue;
        found.cutting_count += cuts_[std::size_t(f)];
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
    std::vector<double> turns(std::size_t(source_.vertex_count()), 0);
    for (int f = 0; f < source_.face_count(); ++f) {
        if (verdict_[std::size_t(f)] == Verdict::left_out) continue;
        for (int k = 0; k < 3; ++k) turns[std::size_t(source_.faces(f, k))] += turn(f, k);
    }
    for (std::size_t v = 0; v < turns.size(); ++v)
        if (std::abs(turns[v]) >= 3 * std::numbers::pi) found.branch_vertices.push_back(int(v));
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
