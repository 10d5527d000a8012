#include "varimap/verification/evaluation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fixtures/shapes.h"
#include "varimap/core/error.h"

namespace varimap {
namespace {

/// A flat square of side n - 1 with n x n vertices; vertex y n + x lies at (x, y).
TriangleMesh square(int n) {
    TriangleMesh mesh{Points(n * n, 3), shapes::grid_faces(n)};
    for (int i = 0; i < n * n; ++i) mesh.vertices.row(i) << i % n, i / n, 0;
    return mesh;
}

PointMap to_vertices(const TriangleMesh& mesh, const std::vector<int>& images) {
    PointMap map;
    for (int image : images) {
        SurfacePoint point;
        for (int f = 0; f < mesh.face_count(); ++f)
            for (int k = 0; k < 3; ++k)
                if (mesh.faces(f, k) == image) point = {f, Vec3::Unit(k)};
        map.push_back(point);
    }
    return map;
}

TEST(Evaluation, OfTheTrueMapIsZero) {
    const TriangleMesh mesh = square(4);
    const std::vector<int> rows{0, 5, 10, 15};
    const MapErrors errors = map_errors(to_vertices(mesh, rows), mesh, {0, 1, 2, 3}, rows);
    EXPECT_EQ(errors.maximum(), 0);
    EXPECT_EQ(errors.mean(), 0);
    EXPECT_EQ(errors.share_within(0), 1);
}

/// Images one step along x from where they belong; true images a step off at random besides.
TEST(Evaluation, RoundingOfTheTruthAveragesOut) {
    const int n = 40;
    const TriangleMesh mesh = square(n);
    std::vector<int> sources, truths, images;
    unsigned random = 1;
    const auto step = [&] { return int((random = random * 1103515245u + 12345u) >> 16) % 3 - 1; };
    for (int y = 2; y < n - 2; ++y)
        for (int x = 2; x < n - 2; ++x) {
            sources.push_back(int(sources.size()));
            images.push_back(y * n + x + 1);
            truths.push_back((y + step()) * n + x + step());
        }
    const MapErrors errors = map_errors(to_vertices(mesh, images), mesh, sources, truths);
    ASSERT_TRUE(errors.smoothed_mean);
    EXPECT_GT(errors.mean(), 1.2 / (n - 1));
    EXPECT_NEAR(*errors.smoothed_mean, 1. / (n - 1), .15 / (n - 1));
}

TEST(Evaluation, SparseTruthIsNotSmoothed) {
    const TriangleMesh mesh = square(4);
    const std::vector<int> rows{0, 5, 10, 15};
    EXPECT_FALSE(map_errors(to_vertices(mesh, rows), mesh, {0, 1, 2, 3}, rows).smoothed_mean);
}

TEST(Evaluation, MeasuresInUnitsOfTheRootOfTheTargetsArea) {
    for (double scale : {1., 1000.}) {
        TriangleMesh mesh = square(5);  // side 4, so one step is an error of 1/4
        mesh.vertices *= scale;
        const auto map = to_vertices(mesh, {0, 0, 0, 0});
        const MapErrors errors = map_errors(map, mesh, {0, 1, 2, 3}, {0, 1, 2, 12});
        ASSERT_EQ(errors.errors.size(), 4u);
        EXPECT_NEAR(errors.errors[1], .25, 1e-12);
        EXPECT_NEAR(errors.errors[2], .5, 1e-12);
        EXPECT_NEAR(errors.maximum(), std::sqrt(8.) / 4, 1e-12);
        EXPECT_NEAR(errors.median(), .375, 1e-12);
        EXPECT_NEAR(errors.mean(), (.75 + std::sqrt(8.) / 4) / 4, 1e-12);
        EXPECT_EQ(errors.share_within(.3), .5);
    }
}

TEST(Evaluation, LeavesOutWhatHasNoImage) {
    const TriangleMesh mesh = square(3);
    PointMap map = to_vertices(mesh, {0, 1, 2});
    map[1].face = -1;
    const MapErrors errors = map_errors(map, mesh, {0, 1, 2}, {0, 1, 2});
    EXPECT_EQ(errors.unmapped, 1);
    EXPECT_EQ(errors.errors.size(), 2u);
}

TEST(Evaluation, RefusesWhatDoesNotFit) {
    TriangleMesh mesh = square(3);
    mesh.vertices.conservativeResize(10, 3);
    mesh.vertices.row(9) << 7, 7, 7;
    const PointMap map = to_vertices(mesh, {0, 1});
    EXPECT_THROW(map_errors(map, mesh, {0, 1}, {0}), InputError);
    EXPECT_THROW(map_errors(map, mesh, {0, 2}, {0, 1}), InputError);
    EXPECT_THROW(map_errors(map, mesh, {0, 1}, {0, 10}), InputError);
    EXPECT_THROW(map_errors(map, mesh, {0, 1}, {0, 9}), InputError);
    EXPECT_THROW(map_errors({{8, Vec3(1, 0, 0)}}, mesh, {0}, {0}), InputError);
    EXPECT_THROW(map_errors({{-1, Vec3(0, 0, 0)}}, mesh, {0}, {0}), InputError);
}

TEST(Evaluation, MeasuresStraightBetweenComponents) {
    TriangleMesh two = square(2);  // and the same once more, 3 above
    two.vertices.conservativeResize(8, 3);
    two.vertices.bottomRows(4) = two.vertices.topRows(4).rowwise() + Eigen::RowVector3d(0, 0, 3);
    two.faces.conservativeResize(4, 3);
    two.faces.bottomRows(2) = two.faces.topRows(2).array() + 4;
    const MapErrors errors = map_errors(to_vertices(two, {0, 1, 2}), two, {0, 1, 2}, {4, 1, -1});
    EXPECT_EQ(errors.apart, 1);
    EXPECT_EQ(errors.unmapped, 1);
    EXPECT_NEAR(errors.maximum(), 3 / std::sqrt(2), 1e-12);
}

TEST(Evaluation, CurveRisesFromExactHitsToAll) {
    const MapErrors errors{{0, .01, .02, .2}, 0};
    const std::string csv = curve_csv(errors);
    EXPECT_EQ(csv.substr(0, 27), "error,share\n0.0000,0.250000");
    EXPECT_NE(csv.find("\n0.0100,0.500000\n"), std::string::npos);
    EXPECT_NE(csv.find("\n0.2500,1.000000\n"), std::string::npos);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 102);
}

}  // namespace
}  // namespace varimap
