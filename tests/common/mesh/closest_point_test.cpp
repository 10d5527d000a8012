#include "varimap/mesh/closest_point.h"

#include <gtest/gtest.h>

#include <random>

#include "fixtures/shapes.h"

namespace varimap {
namespace {

/// Every face in turn; the first of equals stays.
ClosestPoint::Hit brute_force(const TriangleMesh& mesh, const Vec3& query, const Vec3* normal = nullptr) {
    ClosestPoint::Hit best{{}, INFINITY};
    for (int f = 0; f < mesh.face_count(); ++f) {
        if (normal && !(face_normal(mesh, f).dot(*normal) > 0)) continue;
        const SurfacePoint point{
            f, closest_barycentric(query, mesh.vertex(mesh.faces(f, 0)), mesh.vertex(mesh.faces(f, 1)),
                                   mesh.vertex(mesh.faces(f, 2)))};
        const double squared = (position(mesh, point) - query).squaredNorm();
        if (squared < best.squared_distance) best = {point, squared};
    }
    return best;
}

void expect_equal(const ClosestPoint::Hit& a, const ClosestPoint::Hit& b) {
    EXPECT_EQ(a.point.face, b.point.face);
    EXPECT_EQ(a.squared_distance, b.squared_distance);
    EXPECT_EQ(a.point.barycentric, b.point.barycentric);
}

class ClosestPointTest : public ::testing::Test {
  protected:
    Vec3 random_vector() {
        std::uniform_real_distribution<double> uniform(-1, 1);
        const double x = uniform(random_), y = uniform(random_);
        return {x, y, uniform(random_)};
    }
    std::mt19937 random_{1};
};

TEST_F(ClosestPointTest, BarycentricCoordinatesMinimiseTheDistance) {
    for (int i = 0; i < 300; ++i) {
        const Vec3 q = 2 * random_vector(), a = random_vector(), b = random_vector();
        const Vec3 c = i % 3 == 0   ? Vec3(a + 1e-9 * random_vector())
                       : i % 3 == 1 ? Vec3(2 * b - a)
                                    : random_vector();
        const Vec3 best = closest_barycentric(q, a, b, c);
        EXPECT_GE(best.minCoeff(), 0);
        EXPECT_NEAR(best.sum(), 1, 1e-14);
        const double distance = (best[0] * a + best[1] * b + best[2] * c - q).norm();
        for (int u = 0; u <= 20; ++u)
            for (int v = 0; u + v <= 20; ++v)
                EXPECT_LE(distance, ((20 - u - v) / 20. * a + u / 20. * b + v / 20. * c - q).norm() + 1e-12);
    }
}

TEST_F(ClosestPointTest, TrianglesWithoutAPlaneAreTheirSides) {
    for (int i = 0; i < 300; ++i) {
        const Vec3 a = random_vector(), b = random_vector(), q = a + std::abs(random_vector()[0]) * (b - a);
        const Vec3 c = a + random_vector()[0] * (b - a);  // all four collinear up to rounding
        const Vec3 best = closest_barycentric(q, a, b, c);
        EXPECT_LT((best[0] * a + best[1] * b + best[2] * c - q).norm(), 1e-12);
    }
}

TEST_F(ClosestPointTest, PointTriangleIsItsPoint) {
    const Vec3 a(1, 2, 3);
    const Vec3 best = closest_barycentric({0, 0, 0}, a, a, a);
    EXPECT_NEAR(best.sum(), 1, 0);
    EXPECT_GE(best.minCoeff(), 0);
}

TEST_F(ClosestPointTest, AgreesWithBruteForceNearAndFarAndOffCentre) {
    for (const Vec3& offset : {Vec3(0, 0, 0), Vec3(1e4, -2e4, 5e3)}) {
        const TriangleMesh mesh = shapes::moved(shapes::figure(.15), 1, .7, offset);
        const ClosestPoint closest(mesh);
        for (int i = 0; i < 300; ++i) {
            const double reach = i % 3 == 0 ? 3 : i % 3 == 1 ? 300 : .01;
            const int v = i * 7 % mesh.vertex_count();
            const Vec3 query = mesh.vertex(v) + reach * random_vector();
            expect_equal(closest(query), brute_force(mesh, query));
            const Vec3 normal = random_vector();
            expect_equal(closest(query, normal), brute_force(mesh, query, &normal));
        }
    }
}

TEST_F(ClosestPointTest, TiesGoToTheLowestFace) {
    const TriangleMesh mesh = shapes::torus(2, .5, 24, 12);
    const ClosestPoint closest(mesh);
    for (int v = 0; v < mesh.vertex_count(); ++v)
        expect_equal(closest(mesh.vertex(v)), brute_force(mesh, mesh.vertex(v)));
    expect_equal(closest({0, 0, 0}), brute_force(mesh, {0, 0, 0}));
    TriangleMesh doubled = mesh;  // every face twice
    doubled.faces.resize(2 * mesh.face_count(), 3);
    doubled.faces << mesh.faces, mesh.faces;
    const ClosestPoint closest_of_two(doubled);
    for (int i = 0; i < 100; ++i)
        EXPECT_LT(closest_of_two(3 * random_vector()).point.face, mesh.face_count());
}

TEST_F(ClosestPointTest, OppositeSidesOfAThinPlateAreToldApart) {
    TriangleMesh plate = shapes::square(4), under = plate;
    under.vertices.col(2).array() -= 1e-3;
    under.faces.col(1).swap(under.faces.col(2));
    under.faces.array() += plate.vertex_count();
    const int faces = plate.face_count();
    TriangleMesh both;
    both.vertices.resize(2 * plate.vertex_count(), 3);
    both.vertices << plate.vertices, under.vertices;
    both.faces.resize(2 * faces, 3);
    both.faces << plate.faces, under.faces;
    const ClosestPoint closest(both);
    const Vec3 above(.4, .3, .1);
    EXPECT_LT(closest(above).point.face, faces);
    EXPECT_LT(closest(above, Vec3(0, 0, 1)).point.face, faces);
    EXPECT_GE(closest(above, Vec3(0, 0, -1)).point.face, faces);
}

TEST_F(ClosestPointTest, WithoutAnAgreeingNormalTheClosestOfAllIsFound) {
    const TriangleMesh mesh = shapes::square(3);
    const ClosestPoint closest(mesh);
    const Vec3 query(.2, .7, -.5);
    expect_equal(closest(query, Vec3(0, 0, -1)), closest(query));
}

TEST_F(ClosestPointTest, MeshWithoutExtentIsServed) {
    const TriangleMesh point = shapes::make_mesh({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {{0, 1, 2}});
    const ClosestPoint closest(point);
    EXPECT_EQ(closest({1, 1, 3}).squared_distance, 4);
    EXPECT_EQ(closest({1, 1, 3}, {0, 0, 1}).point.face, 0);
}

TEST(ClosestPoint, AGuessChangesNothing) {
    const TriangleMesh mesh = shapes::ellipsoid(3, {1, 1.2, 1.6});
    const ClosestPoint closest(mesh);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> coordinate(-2, 2);
    for (int i = 0; i < 500; ++i) {
        const Vec3 query(coordinate(random), coordinate(random), coordinate(random)), normal = -query;
        const int guess = int(random() % unsigned(mesh.face_count()));
        for (const auto& [plain, guessed] :
             {std::pair(closest(query), closest(query, guess)),
              std::pair(closest(query, normal), closest(query, normal, guess))}) {
            EXPECT_EQ(guessed.point.face, plain.point.face);
            EXPECT_EQ(guessed.point.barycentric, plain.point.barycentric);
            EXPECT_EQ(guessed.squared_distance, plain.squared_distance);
        }
    }
}

TEST(ClosestPoint, UnusedVerticesAndFarQueriesLeadNowhereElse) {
    TriangleMesh mesh = shapes::ellipsoid(2);
    const ClosestPoint plain(mesh);
    mesh.vertices.conservativeResize(mesh.vertex_count() + 1, 3);
    mesh.vertices.bottomRows(1).setConstant(1e200);  // no face uses it
    const ClosestPoint closest(mesh);
    for (const Vec3& query : {Vec3(.3, .2, 1), Vec3(5, 0, 0)})
        EXPECT_EQ(closest(query).point.face, plain(query).point.face);
    for (const double far : {1e10, 1e100, 1e155, 1e300}) {
        const auto hit = closest(Vec3(0, 0, far));
        ASSERT_GE(hit.point.face, 0) << far;
        EXPECT_GT(position(mesh, hit.point)[2], .8) << far;
        EXPECT_GE(closest(Vec3(-far, far, 0), Vec3(0, 0, 1)).point.face, 0);
    }
}

/// Of many sizes, so that for some of them rounding puts the farthest point that counts farther still.
TEST(ClosestPoint, FarQueriesHaveAnAnswerForEverySize) {
    for (int tenths = 1; tenths < 200; ++tenths) {
        TriangleMesh mesh = shapes::ellipsoid(1);
        const Box box = bounding_box(mesh);
        mesh.vertices *= .1 * tenths / (box.high - box.low).maxCoeff();
        for (const double far : {5e6, 1e9}) EXPECT_GE(ClosestPoint(mesh)(Vec3(far, 0, 0)).point.face, 0);
    }
}

}  // namespace
}  // namespace varimap
