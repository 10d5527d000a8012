#include "varimap/parts/part_replacement.h"

#include <gtest/gtest.h>

#include "fixtures/bad_maps.h"
#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"

namespace varimap {
namespace {

/// A figure, another pose of it, and a map between them that is damaged on one leg.
struct LegTrial {
    TriangleMesh rest, posed = shapes::figure_pose(0.5)(rest);
    VertexData<bool> leg = shapes::on_leg(rest), fixed{rest.vertex_count()};
    SlidingMap map;
    const PointMap nothing_known = PointMap(rest.vertex_count());  ///< of the other direction
    PartReplacement replacement;

    explicit LegTrial(PointMap (*damaged)(const TriangleMesh&), const PartReplacementOptions& options = {},
                      TriangleMesh figure = shapes::figure(0.15))
        : rest(std::move(figure)), map(damaged(rest), rest, posed), replacement(map, fixed, options) {}
    double error() const { return shapes::mean_error(map.points(), posed, leg); }
    /// Faces of the leg; elsewhere the figure itself has a few.
    int reversed() const {
        int count = 0;
        for (int f = 0; f < rest.face_count(); ++f)
            count += leg[rest.faces(f, 0)] && map.image_triangle(f).D <= 0;
        return count;
    }
    void expect_undone() const {
        EXPECT_GT(replacement.report().replaced, 0);
        EXPECT_EQ(reversed(), 0);
        EXPECT_LT(error(), 0.2 * shapes::longest_edge(posed));
    }
};

void expect_same(const PointMap& a, const PointMap& b) {
    int different = 0;
    for (std::size_t v = 0; v < a.size(); ++v)
        different += a[v].face != b[v].face || a[v].barycentric != b[v].barycentric;
    EXPECT_EQ(different, 0);
}

PointMap half_a_turn(const TriangleMesh& figure) {
    return shapes::twisted_leg(figure, 0.5);
}
/// One leg crumpled, the images of another's vertices in the opposite order.
PointMap two_legs(const TriangleMesh& figure) {
    PointMap map = shapes::crumpled_leg(figure);
    TriangleMesh across = figure;
    across.vertices.col(0) *= -1;
    const std::vector<char> other_leg = shapes::on_leg(across);
    std::vector<int> vertices;
    for (int v = 0; v < figure.vertex_count(); ++v)
        if (other_leg[std::size_t(v)]) vertices.push_back(v);
    const PointMap at = shapes::at_vertices(figure);
    for (std::size_t i = 0; i < vertices.size(); ++i)
        map[std::size_t(vertices[i])] = at[std::size_t(vertices[vertices.size() - 1 - i])];
    return map;
}
PointMap whole_turn(const TriangleMesh& figure) {
    return shapes::twisted_leg(figure, 1);
}

TEST(PartReplacement, UntwistsALimb) {
    LegTrial trial(half_a_turn);
    EXPECT_GT(trial.error(), 0.1);
    trial.replacement.continue_surroundings(trial.nothing_known);
    trial.expect_undone();
}

/// The foot is where it belongs: only the strain tells, and relaxation finds no way back.
TEST(PartReplacement, UntwistsALimbByAWholeTurn) {
    LegTrial trial(whole_turn);
    trial.replacement.continue_surroundings(trial.nothing_known);
    trial.expect_undone();
}

/// Both directions are twisted alike, so that the other one speaks for the twist, however much it counts.
TEST(PartReplacement, UntwistsALimbThatTheOtherDirectionTwistsBack) {
    PartReplacementOptions options;
    options.inverse_weight = 1e5;
    LegTrial trial(half_a_turn, options);
    trial.replacement.continue_surroundings(shapes::twisted_leg(trial.rest, -0.5));
    trial.expect_undone();
}

TEST(PartReplacement, VerticesWithoutFacesCountForNothing) {
    TriangleMesh more = shapes::figure(0.15);
    const Eigen::Index used = more.vertices.rows();
    more.vertices.conservativeResize(60 * used, 3);
    more.vertices.bottomRows(59 * used).setZero();
    LegTrial trial(two_legs), other(two_legs, {}, more);
    trial.replacement.continue_surroundings(trial.nothing_known);
    other.replacement.continue_surroundings(other.nothing_known);
    EXPECT_EQ(trial.replacement.report().tried, 2);
    EXPECT_EQ(other.replacement.report().tried, 2);
    PointMap images = other.map.points();
    images.resize(std::size_t(used));
    expect_same(trial.map.points(), images);
}

TEST(PartReplacement, UnmirrorsALimb) {
    LegTrial trial(shapes::mirrored_leg);
    EXPECT_GT(trial.reversed(), 100);
    trial.replacement.continue_surroundings(trial.nothing_known);
    trial.expect_undone();
}

TEST(PartReplacement, UncrumplesALimb) {
    LegTrial trial(shapes::crumpled_leg);
    EXPECT_GT(trial.reversed(), 100);
    trial.replacement.continue_surroundings(trial.nothing_known);
    trial.expect_undone();
}

TEST(PartReplacement, TakesACrumpledLimbFromTheInverse) {
    LegTrial trial(shapes::crumpled_leg);
    trial.replacement.adopt_inverse(shapes::at_vertices(trial.rest), false);
    trial.expect_undone();
    EXPECT_LT(trial.replacement.report().area_percent, 50);
}

TEST(PartReplacement, TakesAWholeMapFromTheInverse) {
    LegTrial trial([](const TriangleMesh& figure) { return shapes::noisy_identity(figure, 6); });
    EXPECT_GT(trial.reversed(), 100);
    trial.replacement.adopt_inverse(shapes::at_vertices(trial.rest), true);
    trial.expect_undone();
    EXPECT_GT(trial.replacement.report().area_percent, 100 - 1e-9);
}

TEST(PartReplacement, KeepsALimbThatTheInverseHasWorse) {
    LegTrial trial(half_a_turn);
    const PointMap before = trial.map.points();
    trial.replacement.adopt_inverse(shapes::crumpled_leg(trial.rest), false);
    EXPECT_GT(trial.replacement.report().tried, 0);
    EXPECT_EQ(trial.replacement.report().replaced, 0);
    expect_same(trial.map.points(), before);
}

TEST(PartReplacement, DoesNotTakeAnEqualMapFromTheInverse) {
    const TriangleMesh egg = shapes::ellipsoid(3, {1.2, 1, 0.8}),
                       stretched = shapes::ellipsoid(3, {2.4, 1, 0.8});
    const PointMap identity = shapes::at_vertices(egg);
    const VertexData<bool> fixed(egg.vertex_count());
    SlidingMap map(identity, egg, stretched);
    PartReplacement replacement(map, fixed, {});
    replacement.adopt_inverse(identity, true);
    EXPECT_EQ(replacement.report().replaced, 0) << "relaxation alone is no gain";
    expect_same(map.points(), identity);
}

TEST(PartReplacement, LeavesAPartTooLargeToHaveSurroundings) {
    const TriangleMesh sphere = shapes::ellipsoid(3);
    const PointMap before = shapes::noisy_identity(sphere, 3);
    const VertexData<bool> fixed(sphere.vertex_count());
    SlidingMap map(before, sphere, sphere);
    PartReplacementOptions options;
    options.strain.contrast = 0;  // strained as it is all over
    PartReplacement replacement(map, fixed, options);
    replacement.continue_surroundings(PointMap(sphere.vertex_count()));
    EXPECT_GT(replacement.report().tried, 0);
    EXPECT_EQ(replacement.report().replaced, 0);
    expect_same(map.points(), before);
}

TEST(PartReplacement, TriesNothingOnAGoodMap) {
    LegTrial trial(shapes::at_vertices);
    const PointMap before = trial.map.points();
    trial.replacement.continue_surroundings(trial.nothing_known);
    trial.replacement.adopt_inverse(shapes::crumpled_leg(trial.rest), false);
    EXPECT_EQ(trial.replacement.report().tried, 0);
    expect_same(trial.map.points(), before);
}

TEST(PartReplacement, KeepsLandmarks) {
    LegTrial trial(shapes::crumpled_leg);
    const PointMap truth = shapes::at_vertices(trial.posed);
    std::vector<int> landmarks;
    for (int v = 0; v < trial.leg.size(); v += 40)
        if (trial.leg[v]) landmarks.push_back(v);
    ASSERT_GT(landmarks.size(), 2u);
    for (const int v : landmarks) {
        trial.fixed[v] = 1;
        trial.map.place(v, truth[v]);
    }
    trial.replacement.continue_surroundings(trial.nothing_known);
    trial.expect_undone();
    for (const int v : landmarks) {
        EXPECT_EQ(trial.map.point(v).face, truth[v].face);
        EXPECT_EQ(trial.map.point(v).barycentric, truth[v].barycentric);
    }
}

}  // namespace
}  // namespace varimap
