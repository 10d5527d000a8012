#include "varimap/geodesics/geodesic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "fixtures/shapes.h"

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

/// A flat n x n grid with pseudo-randomly moved inner vertices, stretched along x.
TriangleMesh flat_grid(int n, double stretch) {
    std::mt19937 random(7);
    const auto jitter = [&] { return .6 * (double(random()) / double(std::mt19937::max()) - .5); };
    TriangleMesh mesh{Points(n * n, 3), shapes::grid_faces(n)};
    for (int i = 0; i < n * n; ++i) {
        const int x = i % n, y = i / n;
        const bool inner = x > 0 && y > 0 && x < n - 1 && y < n - 1;
        mesh.vertices.row(i) << stretch * (x + (inner ? jitter() : 0)), y + (inner ? jitter() : 0), 0;
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
    // The last two have triangles up to ten times as long as wide.
    for (const TriangleMesh& mesh : {shapes::ellipsoid(3), globe(40, 40), globe(80, 25), globe(20, 160)}) {
        const auto errors = sphere_errors(mesh);
        ASSERT_GT(errors.size(), 250u);
        EXPECT_LT(errors.back(), .01);
        EXPECT_LT(errors[errors.size() / 2], .003);
    }
}

TEST(Geodesic, IsEuclideanOnAFlatGrid) {
    for (double stretch : {1., 4., 20.}) {
        const TriangleMesh mesh = flat_grid(25, stretch);
        const Geodesic distance(mesh);
        std::mt19937 random(5);
        for (int i = 0; i < 300; ++i) {
            const SurfacePoint a = random_point(mesh, random, i), b = random_point(mesh, random, i / 3);
            const double exact = (position(mesh, a) - position(mesh, b)).norm();
            EXPECT_NEAR(distance(a, b), exact, 1e-12 * (1 + exact));
        }
    }
}

TEST(Geodesic, LeadsAroundTheCornersOfABoundary) {
    // An L of three unit squares: the way from end to end touches the inner corner.
    TriangleMesh mesh{Points(8, 3), Faces(6, 3)};
    mesh.vertices << 0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0, 0, 2, 0, 1, 2, 0;
    mesh.faces << 0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4, 3, 4, 7, 3, 7, 6;
    const Geodesic distance(mesh);
    const SurfacePoint top{5, Vec3(0, .25, .75)}, right{2, Vec3(0, .25, .75)};
    EXPECT_NEAR(distance(top, right), std::hypot(.75, 1.) + std::hypot(1., .25), 1e-12);
}

TEST(Geodesic, UnfoldsACube) {
    TriangleMesh mesh{Points(8, 3), Faces(12, 3)};
    for (int v = 0; v < 8; ++v) mesh.vertices.row(v) << v % 2, v / 2 % 2, v / 4;
    mesh.faces << 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1,
        3, 7, 1, 7, 5;
    const Geodesic distance(mesh);
    const SurfacePoint corner{0, Vec3(1, 0, 0)}, opposite{2, Vec3(0, 0, 1)}, bottom{0, Vec3(.5, 0, .5)},
        top{2, Vec3(.5, 0, .5)};
    EXPECT_NEAR(distance(corner, opposite), std::sqrt(5.), 1e-12);
    EXPECT_NEAR(distance(bottom, top), 2, 1e-12);
}

TEST(Geodesic, DoesNotDependOnWhichFaceNamesAVertexOrAnEdge) {
    const TriangleMesh mesh = shapes::ellipsoid(2);
    const Geodesic distance(mesh);
    const SurfacePoint goal{17, Vec3(.2, .3, .5)};
    for (int f = 0; f < mesh.face_count(); ++f)
        for (int k = 0; k < 3; ++k) {
            if (mesh.faces(f, k) != 40) continue;
            const SurfacePoint same{f, Vec3::Unit(k)};
            EXPECT_NEAR(distance(same, goal), arc(mesh, same, goal), .05);
            EXPECT_EQ(distance(same, {f, Vec3::Unit((k + 1) % 3)}),
                      (mesh.vertex(40) - mesh.vertex(mesh.faces(f, (k + 1) % 3))).norm());
        }
}

TEST(Geodesic, IsSymmetricToTheLastBit) {
    const TriangleMesh mesh = shapes::ellipsoid(2);
    const Geodesic distance(mesh);
    std::mt19937 random(9);
    for (int i = 0; i < 200; ++i) {
        const SurfacePoint a = random_point(mesh, random, i), b = random_point(mesh, random, i / 3);
        EXPECT_EQ(distance(a, b), distance(b, a));
        EXPECT_EQ(distance(a, a), 0);
    }
}

TEST(Geodesic, IsInfiniteBetweenComponents) {
    TriangleMesh mesh{Points(6, 3), Faces(2, 3)};
    mesh.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 5, 1, 0, 5, 0, 1, 5;
    mesh.faces << 0, 1, 2, 3, 4, 5;
    EXPECT_TRUE(std::isinf(Geodesic(mesh)({0, Vec3(.2, .3, .5)}, {1, Vec3(.2, .3, .5)})));
}

}  // namespace
}  // namespace varimap
