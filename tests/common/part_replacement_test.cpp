#include "common/mapping/part_replacement.h"

#include <gtest/gtest.h>

#include "common/bad_maps.h"
#include "common/map_shapes.h"
#include "common/shapes.h"

namespace varimap {
namespace {

/// A figure, another pose of it, and a map between them that is damaged on one leg.
struct LegTrial {
    TriangleMesh rest = shapes::figure(0.15), posed = shapes::figure_pose(0.5)(rest);
    std::vector<char> leg = shapes::on_leg(rest), fixed = std::vector<char>(leg.size(), 0);
    MovingMap map;
    PartReplacement replacement;

    explicit LegTrial(PointMap (*damaged)(const TriangleMesh&))
        : map(damaged(rest), rest, posed), replacement(map, fixed, {}) {}
    double error() const { return shapes::mean_error(map.points(), posed, leg); }
    /// Faces of the leg; where the pose creases the figure the true map has some.
    int reversed() const {
        int count = 0;
        for (int f = 0; f < rest.face_count(); ++f)
            count += leg[std::size_t(rest.faces(f, 0))] && map.chord(f).D <= 0;
        return count;
    }
    void expect_undone() const {
        EXPECT_GT(replacement.report().replaced, 0);
        EXPECT_EQ(reversed(), 0);
        EXPECT_LT(error(), 0.2 * shapes::longest_edge(posed));
    }
};

TEST(PartReplacement, UntwistsALimb) {
    LegTrial trial(shapes::twisted_leg);
    EXPECT_GT(trial.error(), 0.1);
    trial.replacement.continue_surroundings();
    trial.expect_undone();
}

TEST(PartReplacement, UnmirrorsALimb) {
    LegTrial trial(shapes::mirrored_leg);
    EXPECT_GT(trial.reversed(), 100);
    trial.replacement.continue_surroundings();
    trial.expect_undone();
}

TEST(PartReplacement, UncrumplesALimb) {
    LegTrial trial(shapes::crumpled_leg);
    EXPECT_GT(trial.reversed(), 100);
    trial.replacement.continue_surroundings();
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
    EXPECT_GT(trial.reversed(), 500);
    trial.replacement.adopt_inverse(shapes::at_vertices(trial.rest), true);
    trial.expect_undone();
    EXPECT_GE(trial.replacement.report().area_percent, 100);
}

TEST(PartReplacement, KeepsALimbThatTheInverseHasWorse) {
    LegTrial trial(shapes::twisted_leg);
    const PointMap before = trial.map.points();
    trial.replacement.adopt_inverse(shapes::crumpled_leg(trial.rest), false);
    EXPECT_GT(trial.replacement.report().tried, 0);
    EXPECT_EQ(trial.replacement.report().replaced, 0);
}

TEST(PartReplacement, TriesNothingOnAGoodMap) {
    LegTrial trial(shapes::at_vertices);
    for (int f = 0; f < trial.rest.face_count(); ++f) if (trial.map.chord(f).D <= 0) std::cout << f << " " << trial.rest.vertices.row(trial.rest.faces(f,0)) << " " << trial.map.chord(f).D << "\n";
    const PointMap before = trial.map.points();
    trial.replacement.continue_surroundings();
    trial.replacement.adopt_inverse(shapes::crumpled_leg(trial.rest), false);
    EXPECT_EQ(trial.replacement.report().tried, 0);
    for (std::size_t v = 0; v < before.size(); ++v) {
        EXPECT_EQ(trial.map.points()[v].face, before[v].face);
        EXPECT_EQ(trial.map.points()[v].barycentric, before[v].barycentric);
    }
}

TEST(PartReplacement, KeepsLandmarks) {
    LegTrial trial(shapes::crumpled_leg);
    const PointMap truth = shapes::at_vertices(trial.posed);
    std::vector<std::size_t> landmarks;
    for (std::size_t v = 0; v < trial.leg.size(); v += 40)
        if (trial.leg[v]) landmarks.push_back(v);
    ASSERT_GT(landmarks.size(), 2u);
    for (const std::size_t v : landmarks) {
        trial.fixed[v] = 1;
        trial.map.place(int(v), truth[v]);
    }
    trial.replacement.continue_surroundings();
    trial.expect_undone();
    for (const std::size_t v : landmarks) {
        EXPECT_EQ(trial.map.points()[v].face, truth[v].face);
        EXPECT_EQ(trial.map.points()[v].barycentric, truth[v].barycentric);
    }
}

}  // namespace
}  // namespace varimap
