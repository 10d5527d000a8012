#include "varimap/spectral/sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fixtures/shapes.h"
#include "varimap/geodesics/geodesic_graph.h"

namespace varimap {
namespace {

/// Vertices on a line, one unit apart.
auto on_line(int n) {
    return [n](int sample, const auto& claim) {
        if (!claim(sample, 0)) return;
        for (int v = sample + 1; v < n && claim(v, v - sample);) ++v;
        for (int v = sample - 1; v >= 0 && claim(v, sample - v);) --v;
    };
}

/// Straight distances on a convex mesh; counts the claims.
auto over_mesh(const TriangleMesh& mesh, const GeodesicGraph& graph, long* claims = nullptr) {
    return [&mesh, &graph, claims](int sample, const auto& claim) {
        std::vector<int> queue;
        const auto visit = [&](int v) {
            if (claims) ++*claims;
            if (claim(v, (mesh.vertex(v) - mesh.vertex(sample)).norm())) queue.push_back(v);
        };
        visit(sample);
        for (std::size_t head = 0; head < queue.size(); ++head)
            for (int e = graph.offset[queue[head]]; e < graph.offset[queue[head] + 1]; ++e)
                visit(graph.target[e]);
    };
}

TEST(Sampling, InsertsTheFarthestVertexEachTime) {
    FarthestPointSampling sampling(101, on_line(101));
    sampling.insert(0);
    sampling.cover(0, 5);
    ASSERT_EQ(sampling.samples().size(), 5u);
    EXPECT_EQ(std::vector<int>(sampling.samples().begin(), sampling.samples().begin() + 3),
              (std::vector{0, 100, 50}));
    EXPECT_EQ(std::max(sampling.samples()[3], sampling.samples()[4]), 75);
    EXPECT_EQ(std::min(sampling.samples()[3], sampling.samples()[4]), 25);
}

TEST(Sampling, StopsWhereEveryVertexIsCovered) {
    FarthestPointSampling sampling(101, on_line(101));
    sampling.insert(0);
    sampling.cover(30, 101);
    EXPECT_EQ(sampling.samples(), (std::vector{0, 100, 50}));
    const std::vector<int> before = sampling.samples();
    sampling.cover(30, 101);
    EXPECT_EQ(sampling.samples(), before);
    sampling.cover(20, 101);
    EXPECT_EQ(sampling.samples().size(), 5u);
    EXPECT_TRUE(std::equal(before.begin(), before.end(), sampling.samples().begin()));
}

TEST(Sampling, IgnoresWhatIsASampleAlready) {
    FarthestPointSampling sampling(11, on_line(11));
    for (int v : {3, 8, 3}) sampling.insert(v);
    EXPECT_EQ(sampling.samples(), (std::vector{3, 8}));
    sampling.cover(-1, 1000);
    EXPECT_EQ(sampling.samples().size(), 11u);
    for (int v = 0; v < 11; ++v)
        EXPECT_EQ(sampling.samples()[std::size_t(sampling.cell()[std::size_t(v)])], v);
}

TEST(Sampling, KeepsCoincidentSamplesApart) {
    // All vertices in one place.
    FarthestPointSampling sampling(4, [](int sample, const auto& claim) {
        for (int i = 0; i < 4; ++i) claim((sample + i) % 4, 0);
    });
    for (int v : {2, 0}) sampling.insert(v);
    sampling.cover(0, 4);
    EXPECT_EQ(sampling.samples(), (std::vector{2, 0}));
    EXPECT_EQ(sampling.cell()[2], 0);
    EXPECT_EQ(sampling.cell()[0], 1);
}

TEST(Sampling, CellsAreThoseOfTheNearestSample) {
    const TriangleMesh mesh = shapes::ellipsoid(3);
    const GeodesicGraph graph(mesh);
    FarthestPointSampling sampling(mesh.vertex_count(), over_mesh(mesh, graph));
    sampling.insert(11);
    sampling.cover(.3, mesh.vertex_count());
    EXPECT_GT(sampling.samples().size(), 30u);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        double nearest = 10;
        for (int s : sampling.samples())
            nearest = std::min(nearest, (mesh.vertex(v) - mesh.vertex(s)).norm());
        const int own = sampling.samples()[std::size_t(sampling.cell()[std::size_t(v)])];
        EXPECT_NEAR((mesh.vertex(v) - mesh.vertex(own)).norm(), nearest, 1e-8);
        EXPECT_LE(nearest, .3);
    }
    // Farthest points are as far from each other as the cover reaches.
    for (int a : sampling.samples())
        for (int b : sampling.samples()) EXPECT_TRUE(a == b || (mesh.vertex(a) - mesh.vertex(b)).norm() > .3);
}

TEST(Sampling, TakesNearlyLinearWork) {
    const auto claims_per_vertex = [](int level) {
        const TriangleMesh mesh = shapes::ellipsoid(level);
        const GeodesicGraph graph(mesh);
        long claims = 0;
        FarthestPointSampling sampling(mesh.vertex_count(), over_mesh(mesh, graph, &claims));
        sampling.insert(0);
        sampling.cover(0, mesh.vertex_count() / 2);
        return double(claims) / mesh.vertex_count();
    };
    // n log n: each fourfold number of vertices adds a constant; quadratic work would multiply by four.
    const double small = claims_per_vertex(2), medium = claims_per_vertex(3), large = claims_per_vertex(4);
    EXPECT_LT(large - medium, 1.5 * (medium - small));
    EXPECT_LT(large, 2 * medium);
}

TEST(Sampling, DoesNotLetRoundingDecideBetweenEqualVertices) {
    // The two ends are equally far but for rounding: the lower number goes first, whichever is farther by it.
    for (const double noise : {-1e-12, 0., 1e-12}) {
        FarthestPointSampling sampling(3, [noise](int sample, const auto& claim) {
            const double position[] = {-1 - noise, 0, 1};
            for (int v = 0; v < 3; ++v) claim(v, std::abs(position[v] - position[sample]));
        });
        sampling.insert(1);
        sampling.cover(.5, 3);
        EXPECT_EQ(sampling.samples(), (std::vector{1, 0, 2}));
    }
}

}  // namespace
}  // namespace varimap
