#include "stages/locate/locate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "fixtures/shapes.h"
#include "fixtures/surface_data.h"
#include "stages/coarsen/coarsen.h"
#include "stages/preprocess/preprocess.h"
#include "varimap/core/error.h"
#include "varimap/core/logged.h"
#include "varimap/pair_stage/landmark_vertices.h"
#include "varimap/pair_stage/pair_inputs.h"

namespace varimap {
namespace {

bool is_in_front(const TriangleMesh& mesh, int f) {
    return mesh.vertices(mesh.faces.row(f), 0).minCoeff() > -.2;
}

Surface sketch_of(const Surface& surface, int vertices) {
    CoarsenParams params;
    params.vertices = vertices;
    params.most_lost = 1;
    return coarsened(surface, params);
}

/// A figure in another pose, the front of the figure at rest, and which faces of the other are that
/// part. Both have the same vertices.
struct Pair {
    Surface part, whole;
    std::vector<char> in_front;
    Landmarks landmarks;

    Pair() {
        const TriangleMesh rest = shapes::figure(.1);
        const TriangleMesh posed = shapes::figure_pose(1)(rest);
        std::vector<int> faces;
        for (int f = 0; f < rest.face_count(); ++f) {
            in_front.push_back(is_in_front(rest, f));
            if (in_front.back()) faces.push_back(f);
        }
        part = preprocess(TriangleMesh{rest.vertices, rest.faces(faces, Eigen::all)}, {});
        whole = preprocess(posed, {});
        // Front feet, the back, the head.
        for (const Vec3& at : {Vec3(.75, .34, -1.38), Vec3(.8, -.36, -1.58), Vec3(.3, 0, 1), Vec3(3, 0, 1)})
            landmarks.vertices.emplace_back(InputVertex{nearest(at)}, InputVertex{nearest(at)});
    }
    int nearest(const Vec3& at) const {
        int best = -1;
        for (const int v : part.input.faces.reshaped())
            if (best < 0 || (part.input.vertex(v) - at).norm() < (part.input.vertex(best) - at).norm())
                best = v;
        return best;
    }
    /// The landmarks with the partners of these exchanged.
    Landmarks exchanged(const std::vector<std::pair<std::size_t, std::size_t>>& pairs) const {
        Landmarks other = landmarks;
        for (const auto& [i, j] : pairs) std::swap(other.vertices[i].second, other.vertices[j].second);
        return other;
    }
    Located locate(bool part_is_source) const { return locate(part_is_source, landmarks); }
    Located locate(bool part_is_source, const Landmarks& used) const {
        const Surface &A = part_is_source ? part : whole, &B = part_is_source ? whole : part;
        LocateParams params;
        params.part = part_is_source ? PartSide::source : PartSide::target;
        const auto sketch = [&](const Surface& surface) {
            return shapes::surface_data(sketch_of(surface, &surface == &part ? 400 : 700), 60);
        };
        return varimap::locate(pair_context(sketch(A), sketch(B), used, 1), A, B,
                               to_mesh_vertices(used.vertices, A, B), params);
    }
    /// Of where the part's vertices were placed, in units of sqrt(area) of the whole. Both files have the
    /// same vertices.
    double mean_error(const PartRegion& region) const {
        double sum = 0, count = 0;
        for (const int v : part.input.faces.reshaped()) {
            sum += (position(whole.input, region.placed[std::size_t(v)]) - whole.input.vertex(v)).norm();
            ++count;
        }
        return whole.scale * sum / count;
    }
    /// Shares of the whole's area: in both, and in one of them.
    double overlap(const PartRegion& region) const {
        std::vector<char> inside(in_front.size(), 0);
        for (const int f : region.faces) inside[std::size_t(f)] = 1;
        double both = 0, one = 0;
        for (std::size_t f = 0; f < in_front.size(); ++f) {
            const double area = face_normal(whole.input, int(f)).norm();
            both += area * (inside[f] && in_front[f]);
            one += area * (inside[f] || in_front[f]);
        }
        return both / one;
    }
};

TEST(LocateStage, FindsThePartOnTheWhole) {
    const Pair pair;
    for (const bool part_is_source : {true, false}) {
        const Located place = pair.locate(part_is_source);
        EXPECT_GT(pair.overlap(place.region), .93);
        EXPECT_LT(place.strain, .1);
        EXPECT_EQ(place.scale, 1);
        EXPECT_LT(pair.mean_error(place.region), .03);
    }
}

TEST(LocateStage, FindsThePartWithFewLandmarksOrNone) {
    const Pair pair;
    for (const std::size_t count : {0u, 2u}) {
        Landmarks few = pair.landmarks;
        few.vertices.resize(count);
        const std::size_t before = logged_warnings().size();
        const Located place = pair.locate(count == 0, few);
        EXPECT_GT(pair.overlap(place.region), .9) << count;
        EXPECT_LT(place.strain, .1) << count;
        EXPECT_LT(pair.mean_error(place.region), .03) << count;
        EXPECT_GT(place.lead, .1) << count;
        EXPECT_TRUE(std::isfinite(place.lead)) << count;
        EXPECT_EQ(logged_warnings().size(), before) << count;
    }
}

TEST(LocateStage, DoesNotGuessBetweenUnits) {
    Pair pair;
    for (const double factor : {.02, 10.}) {
        pair.part.input.vertices *= factor;
        pair.part = preprocess(pair.part.input, {});
        EXPECT_THROW(pair.locate(true, {}), InputError) << factor;
        pair.part.input.vertices /= factor;
    }
}

/// Nothing tells one end of an ellipsoid from the other.
TEST(LocateStage, SaysThatThePartMayLieElsewhere) {
    const TriangleMesh whole = shapes::ellipsoid(4, Vec3(2, 1, 1));
    std::vector<int> faces;
    for (int f = 0; f < whole.face_count(); ++f)
        if (whole.vertices(whole.faces.row(f), 0).minCoeff() > .8) faces.push_back(f);
    const Surface part = preprocess(TriangleMesh{whole.vertices, whole.faces(faces, Eigen::all)}, {}),
                  all = preprocess(whole, {});
    LocateParams params;
    params.part = PartSide::source;
    const std::size_t before = logged_warnings().size();
    const Located place = locate(pair_context(shapes::surface_data(sketch_of(part, 200), 60),
                                              shapes::surface_data(sketch_of(all, 600), 60), {}, 1),
                                 part, all, {}, params);
    EXPECT_LT(std::abs(place.lead), .05);
    ASSERT_EQ(logged_warnings().size(), before + 1);
    EXPECT_THAT(logged_warnings().back(), testing::HasSubstr("agrees with another place"));
}

TEST(LocateStage, SaysWhichLandmarksAreExchanged) {
    const Pair pair;
    const std::size_t before = logged_warnings().size();
    pair.locate(false, pair.exchanged({{1, 3}}));
    ASSERT_EQ(logged_warnings().size(), before + 1);
    EXPECT_THAT(logged_warnings().back(), testing::HasSubstr("landmarks 2 and 4 look exchanged"));
}

/// Where the part comes to lie by them is one of several places, at some of which it is strained so much that
/// this is said as well.
TEST(LocateStage, SaysThatAllLandmarksAreExchanged) {
    const Pair pair;
    const std::size_t before = logged_warnings().size();
    const double strain = pair.locate(false, pair.exchanged({{0, 1}, {2, 3}})).strain;
    const bool much = strain > PartRegion::much_strain;
    ASSERT_EQ(logged_warnings().size(), before + (much ? 2 : 1)) << strain;
    if (much) {
        EXPECT_THAT(logged_warnings()[before], testing::HasSubstr("had to be strained"));
    }
    EXPECT_THAT(logged_warnings().back(),
                testing::HasSubstr("landmarks 1 with 2 and 3 with 4 look exchanged"));
}

/// A part that does not fit is no reason to suspect its landmarks. (Stretched 2.5 times it is strained by .12
/// itself, give or take a rounding.)
TEST(LocateStage, DoesNotCallRightLandmarksExchanged) {
    Pair pair;
    pair.whole.input.vertices.col(1) *= 3;
    pair.whole = preprocess(pair.whole.input, {});
    const std::size_t before = logged_warnings().size();
    EXPECT_GT(pair.locate(true).strain, .12);
    ASSERT_EQ(logged_warnings().size(), before + 1);
    EXPECT_THAT(logged_warnings().back(), testing::HasSubstr("had to be strained"));
}

}  // namespace
}  // namespace varimap
