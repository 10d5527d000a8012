#include "varimap/parts/continuation_scale.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"

namespace varimap {
namespace {

constexpr double cut = 2;  ///< where the open part of the tube begins; it ends at 4

/// A tube, and the same with its part beyond the cut longer by a factor.
struct TubeTrial {
    TriangleMesh tube = shapes::tube(40, 20, false), longer = tube;
    VertexData<bool> open{tube.vertex_count()};

    explicit TubeTrial(double factor) {
        for (int v = 0; v < tube.vertex_count(); ++v) {
            open[v] = tube.vertices(v, 0) > cut;
            if (open[v]) longer.vertices(v, 0) = cut + factor * (tube.vertices(v, 0) - cut);
        }
    }
    double scale() const {
        const SlidingMap map(shapes::at_vertices(tube), tube, longer);
        return continuation_scale(map, open, GeodesicGraph(map.source()), GeodesicGraph(map.target()));
    }
    /// Both surfaces are compared at unit area.
    double expected(double factor) const {
        return factor * std::sqrt(surface_area(tube) / surface_area(longer));
    }
};

TEST(ContinuationScale, IsHowMuchFartherTheTargetExtends) {
    for (const double factor : {0.8, 1., 1.5}) {
        const TubeTrial trial(factor);
        EXPECT_NEAR(trial.scale(), trial.expected(factor), 0.03) << factor;
    }
}

TEST(ContinuationScale, KeepsWithinItsBounds) {
    EXPECT_EQ(TubeTrial(5).scale(), 1.6);
    EXPECT_EQ(TubeTrial(0.2).scale(), 0.6);
}

TEST(ContinuationScale, IsOneWhereThereIsNothingToCompare) {
    TubeTrial trial(1.5);
    trial.open = VertexData<bool>(trial.tube.vertex_count(), true);
    EXPECT_EQ(trial.scale(), 1);
    trial.open = VertexData<bool>(trial.tube.vertex_count(), false);
    EXPECT_EQ(trial.scale(), 1);
}

}  // namespace
}  // namespace varimap
