#include "varimap/multilevel/orientation.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "fixtures/known_pair.h"
#include "fixtures/surface_data.h"

namespace varimap {
namespace {

TriangleMesh mirrored(TriangleMesh mesh) {
    mesh.vertices.col(1) *= -1;
    mesh.faces.col(1).swap(mesh.faces.col(2));
    return mesh;
}

SurfaceData data_of(const TriangleMesh& mesh) {
    return shapes::surface_data(shapes::unit_surface(mesh), 100);
}

/// Orientation of a map from A to B with these centres, whose images lie near these vertices.
Orientation orientation_of(const RowMatrix& centres, const std::vector<int>& near, const LevelPair& pair,
                           const PairContext& context) {
    const OrientedSurface A(context.A().surface.mesh), B(context.B().surface.mesh);
    std::vector<int> partner;
    for (const int v : near) partner.push_back(pair.B.level.cell[std::size_t(v)]);
    return measure_orientation({pair.A, A, context.graph_A()}, {pair.B, B, context.graph_B()}, centres,
                               partner);
}

/// Orientation, at a level's samples, of the map that takes each vertex of A to the vertex of B of the same
/// number.
Orientation orientation_of_the_identity(const LevelPair& pair, const PairContext& context) {
    return orientation_of(pair.B.vertex_points(pair.A.level.samples, Eigen::all), pair.A.level.samples, pair,
                          context);
}

/// Levels of a pair with at least 100 samples.
std::vector<LevelPair> levels_of(const PairContext& context) {
    std::vector<LevelPair> levels;
    for (int l = 0; l < context.diffusion_levels(); ++l) levels.push_back(context.diffusion_level(l));
    for (int l = 0; l < context.euclidean_levels(); ++l) levels.push_back(context.euclidean_level(l, 1));
    std::erase_if(levels, [](const LevelPair& pair) { return pair.A.level.samples.size() < 100; });
    return levels;
}

TEST(Orientation, OfTheIdentityIsPositive) {
    for (const TriangleMesh& mesh : {shapes::ellipsoid(3), shapes::figure(.15)}) {
        const SurfaceData data = data_of(mesh);
        const PairContext context(data, data, {});
        for (const LevelPair& pair : levels_of(context)) {
            const Orientation orientation = orientation_of_the_identity(pair, context);
            EXPECT_EQ(orientation.reversed_mass, 0);
            EXPECT_EQ(orientation.image_vertex, pair.A.level.samples);
            double undecided = 0;
            for (std::size_t k = 0; k < orientation.determinant.size(); ++k)
                if (orientation.determinant[k] == 0)
                    undecided += pair.A.side.mass[Eigen::Index(k)];
                else
                    EXPECT_NEAR(orientation.determinant[k], 1, 1e-6);
            EXPECT_LT(undecided, .1);
        }
    }
}

TEST(Orientation, OfTheMirrorImageIsNegative) {
    for (const TriangleMesh& mesh : {shapes::ellipsoid(3), shapes::figure(.15)}) {
        const PairContext context(data_of(mesh), data_of(mirrored(mesh)), {});
        for (const LevelPair& pair : levels_of(context)) {
            const Orientation orientation = orientation_of_the_identity(pair, context);
            EXPECT_GT(orientation.reversed_mass, .9);
            EXPECT_LE(*std::max_element(orientation.determinant.begin(), orientation.determinant.end()), 0);
        }
    }
}

TEST(Orientation, OfTheTrueMapBetweenPosesIsPositive) {
    const shapes::KnownPair figures = shapes::figure_pair(1, false);
    const PairContext context = figures.context();
    for (const LevelPair& pair : levels_of(context)) {
        std::vector<int> image;
        for (int s : pair.A.level.samples)
            image.push_back(
                shapes::nearest_vertex(context.B().surface.mesh, figures.A_on_B.row(s).transpose()));
        const RowMatrix centres =
            pair.A.side.averaging.P * RowMatrix(pair.B.vertex_points(image, Eigen::all));
        const Orientation orientation = orientation_of(centres, image, pair, context);
        // Coarse levels see two bends as one; measured 0.045 with 226 samples, below 0.005 from 500 samples
        // on.
        EXPECT_LT(orientation.reversed_mass, image.size() < 500 ? .08 : .01)
            << pair.A.level.samples.size() << " samples";
    }
}

TEST(NearestByDescent, FindsTheNearestVertexOfASphere) {
    const Surface surface = shapes::unit_surface(shapes::ellipsoid(3));
    const GeodesicGraph graph(surface.mesh);
    const RowMatrix points = surface.mesh.vertices;
    for (int query = 0; query < 20; ++query) {
        const Vec3 centre = .3 * Vec3(std::sin(query), std::cos(2. * query), std::sin(3. * query + 1));
        const int nearest = shapes::nearest_vertex(surface.mesh, centre);
        for (int start : {0, 100, nearest}) {
            const int found = nearest_by_descent(start, centre.transpose(), points, graph);
            EXPECT_NEAR((surface.mesh.vertex(found) - centre).norm(),
                        (surface.mesh.vertex(nearest) - centre).norm(), 1e-12);
        }
    }
}

}  // namespace
}  // namespace varimap
