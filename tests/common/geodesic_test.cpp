#include "common/mesh/geodesic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

namespace varimap {
namespace {

/// Latitude-longitude sphere of radius 1: near the poles its triangles are long and thin.
TriangleMesh globe(int rings, int sectors) {
    TriangleMesh mesh;
    mesh.vertices.resize((rings - 1) * sectors + 2, 3);
    std::vector<Eigen::Vector3i> faces;
    const auto at = [&](int i, int j) { return (i - 1) * sectors + (j + sectors) % sectors; };
    const int north = (rings - 1) * sectors, south = north + 1;
    for (int i = 1; i < rings; ++i)
        for (int j = 0; j < sectors; ++j) {
            const double u = std::numbers::pi * i / rings, v = 2 * std::numbers::pi * j / sectors;
            mesh.vertices.row(at(i, j)) << std::sin(u) * std::cos(v), std::sin(u) * std::sin(v), std::cos(u);
        }
    mesh.vertices.row(north) << 0, 0, 1;
    mesh.vertices.row(south) << 0, 0, -1;
    for (int j = 0; j < sectors; ++j) {
        faces.emplace_back(north, at(1, j), at(1, j + 1));
        faces.emplace_back(south, at(rings - 1, j + 1), at(rings - 1, j));
        for (int i = 1; i + 1 < rings; ++i) {
            faces.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1));
            faces.emplace_back(at(i, j), at(i + 1, j + 1), at(i, j + 1));
        }
    }
    mesh.faces.resize(int(faces.size()), 3);
    for (size_t f = 0; f < faces.size(); ++f) mesh.faces.row(int(f)) = faces[f];
    return mesh;
}

/// Octahedron subdivided `depth` times, its vertices on the unit sphere.
TriangleMesh octasphere(int depth) {
    TriangleMesh mesh;
    mesh.vertices.resize(6, 3);
    mesh.vertices << 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1;
    mesh.faces.resize(8, 3);
    mesh.faces << 0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5;
    for (; depth > 0; --depth) {
        TriangleMesh fine{mesh.vertices, Faces(4 * mesh.face_count(), 3)};
        std::map<std::pair<int, int>, int> middles;
        const auto middle = [&](int a, int b) {
            const auto [it, added] = middles.try_emplace(std::minmax(a, b), fine.vertex_count());
            if (added) {
                fine.vertices.conservativeResize(fine.vertex_count() + 1, 3);
                fine.vertices.bottomRows(1) = (fine.vertices.row(a) + fine.vertices.row(b)).normalized();
            }
            return it->second;
        };
        for (int f = 0; f < mesh.face_count(); ++f) {
            const Eigen::Vector3i v = mesh.faces.row(f);
            const int a = middle(v[1], v[2]), b = middle(v[2], v[0]), c = middle(v[0], v[1]);
            fine.faces.middleRows(4 * f, 4) << v[0], c, b, c, v[1], a, b, a, v[2], a, b, c;
        }
        mesh = fine;
    }
    return mesh;
}

/// A flat n x n grid with pseudo-randomly moved inner vertices, stretched along x.
TriangleMesh flat_grid(int n, double stretch) {
    std::mt19937 random(7);
    const auto jitter = [&] { return .6 * (double(random()) / double(std::mt19937::max()) - .5); };
    TriangleMesh mesh{Points(n * n, 3), Faces(2 * (n - 1) * (n - 1), 3)};
    for (int i = 0; i < n * n; ++i) {
        const int x = i % n, y = i / n;
        const bool inner = x > 0 && y > 0 && x < n - 1 && y < n - 1;
        mesh.vertices.row(i) << stretch * (x + (inner ? jitter() : 0)), y + (inner ? jitter() : 0), 0;
    }
    for (int y = 0, f = 0; y + 1 < n; ++y)
        for (int x = 0; x + 1 < n; ++x) {
            const int v = y * n + x;
            mesh.faces.row(f++) << v, v + 1, v + n + 1;
            mesh.faces.row(f++) << v, v + n + 1, v + n;
        }
    return mesh;
}

/// Points in faces, on edges and at vertices in turn.
SurfacePoint random_point(const TriangleMesh& mesh, std::mt19937& random, int kind) {
    Vec3 b;
    for (double& x : b) x = double(random()) / double(std::mt19937::max());
    if (kind % 3 >= 1) b[int(random() % 3)] = 0;
    if (kind % 3 == 2) b = Vec3::Unit(int(random() % 3));
    return {int(random() % mesh.face_count()), b / b.sum()};
}

double arc(const TriangleMesh& mesh, const SurfacePoint& a, const SurfacePoint& b) {
    const Vec3 x = position(mesh, a).normalized(), y = position(mesh, b).normalized();
    return std::atan2(x.cross(y).norm(), x.dot(y));
}

/// Relative errors against great circles between random points, in ascending order.
std::vector<double> sphere_errors(const TriangleMesh& mesh) {
    const Geodesic distance(mesh);
    std::mt19937 random(3);
    std::vector<double> errors;
    for (int i = 0; i < 300; ++i) {
        const SurfacePoint a = random_point(mesh, random, i), b = random_point(mesh, random, i / 3);
        const double exact = arc(mesh, a, b);
        if (exact > .2) errors.push_back(std::abs(distance(a, b) / exact - 1));
    }
    std::sort(errors.begin(), errors.end());
    return errors;
}

TEST(Geodesic, IsWithinOnePercentOnSpheres) {
    for (const TriangleMesh& mesh : {octasphere(4), globe(40, 40), globe(80, 25), globe(20, 160)}) {
        const auto errors = sphere_errors(mesh);
        ASSERT_GT(errors.size(), 250u);
        printf("median %g 95%% %g max %g\n", errors[errors.size() / 2], errors[errors.size() * 95 / 100],
               errors.back());
        EXPECT_LT(errors.back(), .01);
    }
}

TEST(Geodesic, IsEuclideanOnAFlatGrid) {
    for (double stretch : {1., 4., 20.}) {
        const TriangleMesh mesh = flat_grid(25, stretch);
        const Geodesic distance(mesh);
        std::mt19937 random(5);
        double sum = 0, worst = 0;
        for (int i = 0; i < 300; ++i) {
            const SurfacePoint a = random_point(mesh, random, i), b = random_point(mesh, random, i / 3);
            const double exact = (position(mesh, a) - position(mesh, b)).norm();
            const double error = distance(a, b) - exact;
            EXPECT_GE(error, -1e-12 * exact);
            EXPECT_LE(error, .01 * exact);
            sum += error / exact;
            worst = std::max(worst, error / exact);
        }
        printf("mean %g worst %g\n", sum / 300, worst);
    }
}

TEST(Geodesic, IsSymmetricToTheLastBit) {
    const TriangleMesh mesh = octasphere(3);
    const Geodesic distance(mesh);
    std::mt19937 random(9);
    for (int i = 0; i < 200; ++i) {
        const SurfacePoint a = random_point(mesh, random, i), b = random_point(mesh, random, i / 3);
        EXPECT_EQ(distance(a, b), distance(b, a));
    }
}

}  // namespace
}  // namespace varimap
