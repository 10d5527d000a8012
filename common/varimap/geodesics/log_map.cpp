#include "varimap/geodesics/log_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "varimap/geodesics/triangle_strip.h"
#include "varimap/mesh/face_geometry.h"

namespace varimap {

namespace {

/// Points near in space and farther along the surface lie on two sides of a tear. Those of torn maps are
/// many, and searches for ways between them were most of the time of repair and verification of a skull's.
constexpr double detour = 6;

int corner_of(const TriangleMesh& mesh, int f, int vertex) {
    return mesh.faces(f, 0) == vertex ? 0 : mesh.faces(f, 1) == vertex ? 1 : 2;
}

/// The faces around a vertex, counter-clockwise; from a boundary, if it has one, or from the lowest.
std::vector<int> fan(const TriangleMesh& mesh, const Edges& edges, int vertex, int face) {
    const auto beyond = [&](int f, int side_of_corner) {
        const int half_edge = 3 * f + (corner_of(mesh, f, vertex) + side_of_corner) % 3;
        return face_beyond(edges, edges.of_half_edge[std::size_t(half_edge)], f);
    };
    std::vector<int> faces{face};
    int next = beyond(face, 2);  // the side that enters the corner lies to the left
    for (; next >= 0 && next != face; next = beyond(next, 2)) faces.push_back(next);
    if (next == face) {
        std::rotate(faces.begin(), std::min_element(faces.begin(), faces.end()), faces.end());
        return faces;
    }
    std::vector<int> before;  // the farthest last
    for (next = beyond(face, 0); next >= 0; next = beyond(next, 0)) before.push_back(next);
    faces.insert(faces.begin(), before.rbegin(), before.rend());
    return faces;
}

/// The vertex that a point is up to rounding, or -1.
int vertex_near(const TriangleMesh& mesh, const SurfacePoint& point) {
    int k = 0;
    return point.face >= 0 && point.barycentric.maxCoeff(&k) > 1 - 1e-9 ? mesh.faces(point.face, k) : -1;
}

bool touches(const Edges& edges, int edge, int vertex) {
    const auto [a, b] = edges.vertices[std::size_t(edge)];
    return a == vertex || b == vertex;
}

TriangleStrip reversed(TriangleStrip strip) {
    std::reverse(strip.faces.begin(), strip.faces.end());
    std::reverse(strip.edges.begin(), strip.edges.end());
    return strip;
}

}  // namespace

Vec2 LogMap::seen_from_vertex(int vertex, const TriangleStrip& strip, const Vec3& to, double length) const {
    // The path leaves the star through the face from which on its edges are others.
    std::ptrdiff_t skipped = 0;
    while (skipped < std::ptrdiff_t(strip.edges.size()) &&
           touches(*edges_, strip.edges[std::size_t(skipped)], vertex))
        ++skipped;
    const TriangleStrip outside{{strip.faces.begin() + skipped, strip.faces.end()},
                                {strip.edges.begin() + skipped, strip.edges.end()}};
    const int face = outside.faces.front();
    double at = 0, total = 0;
    const std::vector<int> around = fan(mesh_, *edges_, vertex, face);
    for (const int f : around) {
        const int k = corner_of(mesh_, f, vertex);
        if (f == face) {
            const Vec3 away =
                straight_path(mesh_, *edges_, outside, mesh_.vertex(vertex), to).goal_from_start;
            at =
                total + angle_between(mesh_.vertex(mesh_.faces(f, (k + 1) % 3)) - mesh_.vertex(vertex), away);
        }
        total += corner_angle(mesh_, f, vertex);
    }
    const int edge =
        edges_->of_half_edge[std::size_t(3 * around.front() + corner_of(mesh_, around.front(), vertex))];
    if (edges_->half_edges[edge].size() > 1) at *= 2 * std::numbers::pi / total;  // the vertex is inside
    return {length * std::cos(at), length * std::sin(at)};
}

Vec2 LogMap::in_plane_of(int face, const Vec3& away) const {
    const Vec3 p = mesh_.vertex(mesh_.faces(face, 0));
    const Vec3 edge = mesh_.vertex(mesh_.faces(face, 1)) - p;
    const Vec3 normal = edge.cross(mesh_.vertex(mesh_.faces(face, 2)) - p);
    return {away.dot(edge.stableNormalized()),
            away.dot(normal.stableNormalized().cross(edge.stableNormalized()))};
}

Vec3 LogMap::in_space(int face, const Vec2& seen) const {
    const Vec3 p = mesh_.vertex(mesh_.faces(face, 0));
    const Vec3 edge = (mesh_.vertex(mesh_.faces(face, 1)) - p).stableNormalized();
    const Vec3 normal = edge.cross(mesh_.vertex(mesh_.faces(face, 2)) - p).stableNormalized();
    return seen[0] * edge + seen[1] * normal.cross(edge);
}

std::pair<Vec2, Vec2> LogMap::operator()(const SurfacePoint& a, const SurfacePoint& b, int farthest) const {
    TriangleStrip strip = straight_strip(mesh_, *edges_, a, b);
    if (strip.faces.empty()) strip = find_strip(mesh_, *edges_, a.face, b.face, farthest, detour);
    if (strip.faces.empty()) return {Vec2::Zero(), Vec2::Zero()};
    const Vec3 start = position(mesh_, a), goal = position(mesh_, b);
    const StraightPath path = straighten(mesh_, *edges_, strip, start, goal);
    const int at_a = vertex_near(mesh_, a), at_b = vertex_near(mesh_, b);
    return {at_a < 0 ? in_plane_of(a.face, path.goal_from_start)
                     : seen_from_vertex(at_a, strip, goal, path.length),
            at_b < 0 ? in_plane_of(b.face, path.start_from_goal)
                     : seen_from_vertex(at_b, reversed(strip), start, path.length)};
}

}  // namespace varimap
