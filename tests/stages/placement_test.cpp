#include "stages/locate/placement.h"

#include <gtest/gtest.h>

#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"
#include "varimap/mesh/closest_point.h"
#include "varimap/mesh/unit_area.h"

namespace varimap {
namespace {

/// The figure of unit area, the part of it in front of a place along it, and images of the part's vertices
/// that lie around their places, farther apart or nearer by a factor.
struct PlacedPair {
    TriangleMesh whole, part;
    PointMap start;
    double share;

    PlacedPair(double behind, double stretch) {
        whole = shapes::figure(.15);
        whole.vertices /= std::sqrt(surface_area(whole));
        std::vector<int> in_front;
        for (int f = 0; f < whole.face_count(); ++f)
            if (whole.vertices(whole.faces.row(f), 0).minCoeff() > behind) in_front.push_back(f);
        part = {whole.vertices, whole.faces(in_front, Eigen::all)};
        share = surface_area(part);
        const ClosestPoint closest(whole);
        const Vec3 middle(.2, 0, 0);
        for (int v = 0; v < part.vertex_count(); ++v)
            start.push_back(closest(middle + stretch * (part.vertex(v) - middle)).point);
    }

    Placement result() const {
        return placed(start, part, whole, VertexData<bool>(part.vertex_count()), share,
                      relief_pairs(unit_area(part), whole), {});
    }
    double mean_error(const PointMap& map) const {
        double sum = 0, count = 0;
        for (const int v : part.faces.reshaped()) {
            sum += (position(whole, map[std::size_t(v)]) - part.vertex(v)).norm();
            ++count;
        }
        return sum / count;
    }
};

/// Nothing but the surfaces' forms says where the rim is.
TEST(Placement, FindsItsRim) {
    for (const double stretch : {.9, 1.1}) {
        const PlacedPair pair(-.05, stretch);
        const double before = pair.mean_error(pair.start);
        const Placement found = pair.result();
        EXPECT_GT(before, .014) << stretch;
        EXPECT_LT(pair.mean_error(found.images), .006) << stretch;  // a quarter of an edge
        EXPECT_LT(found.strain, .01) << stretch;
    }
}

/// A part of another size is strained.
TEST(Placement, IsStrainedWhereItDoesNotFit) {
    PlacedPair pair(-.05, 1);
    const double right = pair.result().strain;
    VertexData<bool> pinned(pair.part.vertex_count());
    for (const int v : pair.part.faces.reshaped())
        if (v % 20 == 0) pinned[v] = true;
    EXPECT_GT(placed(pair.start, pair.part, pair.whole, pinned, .5 * pair.share,
                     relief_pairs(unit_area(pair.part), pair.whole), {})
                  .strain,
              10 * right + .01);
}

/// A wrong try must not win for want of faces to be judged by.
TEST(Placement, WithoutImagesIsWorst) {
    PlacedPair pair(-.05, 1);
    pair.start[std::size_t(pair.part.faces(0, 0))] = {};
    EXPECT_EQ(pair.result().strain, std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace varimap
