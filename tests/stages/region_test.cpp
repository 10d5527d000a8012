#include "stages/locate/region.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "fixtures/shapes.h"
#include "stages/locate/covered.h"
#include "stages/preprocess/preprocess.h"
#include "varimap/core/error.h"
#include "varimap/core/logged.h"
#include "varimap/mesh/closest_point.h"

namespace varimap {
namespace {

/// A part that is a strip along the middle of a square, of this width; the images of its vertices are where
/// they are.
struct Strip {
    Surface whole = preprocess(shapes::square(20), {});
    TriangleMesh part;
    PointMap images;

    explicit Strip(double width) {
        part.vertices.resize(4, 3);
        part.vertices << .1, .51, 0, .9, .51, 0, .9, .51 + width, 0, .1, .51 + width, 0;
        part.faces.resize(2, 3);
        part.faces << 0, 1, 2, 0, 2, 3;
        const ClosestPoint closest(whole.mesh);
        for (int v = 0; v < 4; ++v)
            images.push_back(closest((part.vertex(v) - whole.centre) * whole.scale).point);
    }
    Vec3 middle(int f) const { return position(whole.input, {f, Vec3::Constant(1.0 / 3)}); }
};

TEST(CoveredFaces, HaveTheirMiddlesInside) {
    const Strip strip(.2);
    const FaceData<char> covered = covered_faces(strip.images, strip.part, strip.whole);
    for (int f = 0; f < covered.size(); ++f) {
        const Vec3 at = strip.middle(f);
        const bool inside = at.x() > .1 && at.x() < .9 && at.y() > .51 && at.y() < .71;
        EXPECT_EQ(bool(covered[f]), inside) << at.transpose();
    }
}

TEST(TouchedFaces, LieAlongAStripThatCoversNone) {
    const Strip strip(1e-3);
    const FaceData<char> covered = covered_faces(strip.images, strip.part, strip.whole),
                         touched = touched_faces(strip.images, strip.part, strip.whole);
    EXPECT_EQ(std::count(covered.begin(), covered.end(), 1), 0);
    EXPECT_GT(std::count(touched.begin(), touched.end(), 1), 10);
    for (int f = 0; f < touched.size(); ++f)
        if (touched[f]) {
            EXPECT_LT(std::abs(strip.middle(f).y() - .51), .11) << "two faces away";
        }
}

/// A landmark of the strip lies elsewhere on the square.
TEST(RegionOfAPart, IsJoinedToALandmarkBesideIt) {
    Strip strip(.2);
    Surface part = preprocess(strip.part, {});
    Placement placement;
    const ClosestPoint closest(strip.whole.mesh);
    for (int v = 0; v < part.mesh.vertex_count(); ++v) {
        const Vec3 at = part.mesh.vertex(v) / part.scale + part.centre;
        placement.images.push_back(closest((at - strip.whole.centre) * strip.whole.scale).point);
    }
    int corner = 0;
    for (int v = 1; v < strip.whole.mesh.vertex_count(); ++v)
        if (strip.whole.mesh.vertices.row(v).sum() < strip.whole.mesh.vertices.row(corner).sum()) corner = v;
    const Sides with(part, strip.whole, {{{0}, {corner}}}, PartSide::source),
        without(part, strip.whole, {}, PartSide::source);
    placement.strain = .05;
    const auto has_corner = [&](const std::vector<int>& region) {
        return std::binary_search(region.begin(), region.end(),
                                  strip.whole.on_input[std::size_t(corner)].face);
    };
    std::size_t before = logged_warnings().size();
    EXPECT_FALSE(has_corner(region_of(placement, without)));
    EXPECT_EQ(logged_warnings().size(), before);
    EXPECT_TRUE(has_corner(region_of(placement, with)));
    EXPECT_EQ(logged_warnings().size(), before + 1);
    placement.strain = .3;
    EXPECT_THROW(region_of(placement, with), InputError);
}

}  // namespace
}  // namespace varimap
