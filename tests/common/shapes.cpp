#include "common/shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <random>

namespace varimap::shapes {
TriangleMesh make_mesh(const std::vector<Vec3>& points, const std::vector<std::array<int, 3>>& faces) {
    TriangleMesh mesh;
    mesh.vertices.resize(points.size(), 3);
    for (std::size_t v = 0; v < points.size(); ++v) mesh.vertices.row(v) = points[v].transpose();
    mesh.faces.resize(faces.size(), 3);
    for (std::size_t f = 0; f < faces.size(); ++f) mesh.faces.row(f) << faces[f][0], faces[f][1], faces[f][2];
    return mesh;
}

namespace {

using std::numbers::pi;

const std::vector<std::array<int, 3>> icosahedron_faces{
    {0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};

std::vector<Vec3> icosahedron_points() {
    const double t = std::numbers::phi;
    std::vector<Vec3> points{{-1, t, 0},  {1, t, 0},  {-1, -t, 0}, {1, -t, 0}, {0, -1, t},  {0, 1, t},
                             {0, -1, -t}, {0, 1, -t}, {t, 0, -1},  {t, 0, 1},  {-t, 0, -1}, {-t, 0, 1}};
    for (Vec3& p : points) p.normalize();
    return points;
}

/// Cuts every face into four; new points on the unit sphere.
void subdivide_sphere(std::vector<Vec3>& points, std::vector<std::array<int, 3>>& faces) {
    std::map<std::pair<int, int>, int> midpoint;
    const auto middle = [&](int a, int b) {
        const auto [entry, is_new] =
            midpoint.try_emplace({std::min(a, b), std::max(a, b)}, int(points.size()));
        if (is_new) points.push_back((points[a] + points[b]).normalized());
        return entry->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : faces) {
        const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    faces = finer;
}

/// Faces of a grid of rings: ring i holds vertices i * n ... i * n + n - 1.
void add_ring_faces(std::vector<std::array<int, 3>>& faces, int ring, int next_ring, int n) {
    for (int j = 0; j < n; ++j) {
        const int k = (j + 1) % n;
        const int a = ring * n + j, b = next_ring * n + j, c = next_ring * n + k, d = ring * n + k;
        faces.push_back({a, b, c});
        faces.push_back({a, c, d});
    }
}

}  // namespace

TriangleMesh ellipsoid(int level, const Vec3& radii) {
    std::vector<Vec3> points = icosahedron_points();
    std::vector<std::array<int, 3>> faces = icosahedron_faces;
    for (int i = 0; i < level; ++i) subdivide_sphere(points, faces);
    for (Vec3& p : points) p = p.cwiseProduct(radii);
    return make_mesh(points, faces);
}

TriangleMesh torus(double major_radius, double minor_radius, int around, int across) {
    std::vector<Vec3> points;
    std::vector<std::array<int, 3>> faces;
    for (int i = 0; i < around; ++i) {
        const double u = 2 * pi * i / around;
        for (int j = 0; j < across; ++j) {
            const double v = 2 * pi * j / across, r = major_radius + minor_radius * std::cos(v);
            points.emplace_back(r * std::cos(u), r * std::sin(u), minor_radius * std::sin(v));
        }
        add_ring_faces(faces, i, (i + 1) % around, across);
    }
    return make_mesh(points, faces);
}

TriangleMesh square(int n) {
    std::vector<Vec3> points;
    std::vector<std::array<int, 3>> faces;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j) points.emplace_back(double(i) / n, double(j) / n, 0);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const int a = i * (n + 1) + j, b = a + n + 1;
            faces.push_back({a, b, b + 1});
            faces.push_back({a, b + 1, a + 1});
        }
    return make_mesh(points, faces);
}

namespace {

constexpr double tube_length = 4;

/// The tube's surface at x, angle v; radius tapers, the section is an ellipse, and a bump sits near one end.
Vec3 tube_point(double x, double v) {
    const double taper = 0.45 - 0.04 * x;
    const double bump = 0.25 * std::exp(-(x - 1) * (x - 1) / 0.1 - 2 * (1 - std::cos(v - 1)));
    const double r = taper * (1 + bump / taper);
    return Vec3(x, r * std::cos(v), 0.8 * r * std::sin(v));
}

/// A cap: rings shrink along a half ellipsoid over the end ring at x, then one pole.
Vec3 cap_point(double x, double outward, double t, double v) {
    const Vec3 p = tube_point(x, v);
    const double c = std::cos(t * pi / 2), s = std::sin(t * pi / 2);
    return Vec3(x + outward * 0.3 * s, p[1] * c, p[2] * c);
}

}  // namespace

TriangleMesh tube(int along, int around, bool capped, double phase) {
    std::vector<Vec3> points;
    std::vector<std::array<int, 3>> faces;
    const int cap = capped ? std::max(2, along / 10) : 1;
    for (int i = 1 - cap; i < along + cap - 1; ++i)
        for (int j = 0; j < around; ++j) {
            const double v = -2 * pi * (j + phase) / around;
            if (i < 0)
                points.push_back(cap_point(0, -1, -double(i) / cap, v));
            else if (i >= along)
                points.push_back(cap_point(tube_length, 1, double(i - along + 1) / cap, v));
            else
                points.push_back(tube_point(tube_length * i / (along - 1), v));
        }
    const int rings = int(points.size()) / around;
    for (int i = 0; i + 1 < rings; ++i) add_ring_faces(faces, i, i + 1, around);
    if (capped) {
        const int first = int(points.size()), last_ring = (rings - 1) * around;
        points.emplace_back(-0.3, 0, 0);
        points.emplace_back(tube_length + 0.3, 0, 0);
        for (int j = 0; j < around; ++j) {
            const int k = (j + 1) % around;
            faces.push_back({first, j, k});
            faces.push_back({first + 1, last_ring + k, last_ring + j});
        }
    }
    return make_mesh(points, faces);
}

TriangleMesh shuffled(const TriangleMesh& mesh, unsigned seed, std::vector<int>* old_vertex) {
    std::mt19937 random(seed);
    const auto permutation = [&](int n) {
        std::vector<int> order(n);
        std::iota(order.begin(), order.end(), 0);
        for (int i = n - 1; i > 0; --i) std::swap(order[i], order[random() % unsigned(i + 1)]);
        return order;
    };
    const std::vector<int> vertex = permutation(mesh.vertex_count()), face = permutation(mesh.face_count());
    std::vector<int> renumbered(mesh.vertex_count());
    TriangleMesh result = mesh;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        result.vertices.row(v) = mesh.vertices.row(vertex[v]);
        renumbered[vertex[v]] = v;
    }
    for (int f = 0; f < mesh.face_count(); ++f)
        for (int c = 0; c < 3; ++c) result.faces(f, c) = renumbered[mesh.faces(face[f], c)];
    if (old_vertex) *old_vertex = vertex;
    return result;
}

TriangleMesh moved(TriangleMesh mesh, double scale, double angle, const Vec3& offset) {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    for (int v = 0; v < mesh.vertex_count(); ++v)
        mesh.vertices.row(v) = (scale * (turn * mesh.vertex(v)) + offset).transpose();
    return mesh;
}

}  // namespace varimap::shapes
