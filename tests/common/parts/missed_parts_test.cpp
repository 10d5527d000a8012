#include "varimap/parts/missed_parts.h"

#include <gtest/gtest.h>

#include "fixtures/bad_maps.h"
#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"

namespace varimap {
namespace {

/// A figure, another pose of it, and the identity, but the vertices of one leg on the points closest to
/// move(p).
struct LostLegTrial {
    TriangleMesh rest = shapes::figure(0.15), posed = shapes::figure_pose(0.5)(rest);
    std::vector<char> leg = shapes::on_leg(rest);
    VertexData<bool> fixed{rest.vertex_count()};
    SlidingMap map;

    explicit LostLegTrial(const std::function<Vec3(const Vec3& p)>& move)
        : map(shapes::with_leg(rest, move), rest, posed) {}
    double error() const { return shapes::mean_error(map.points(), posed, leg); }
    bool recover(const PointMap& back) { return recover_missed_parts(map, back, fixed, {}, 400); }
};

/// The leg shrunk to its root.
Vec3 crushed(const Vec3& p) {
    return shapes::leg_origin + .05 * (p - shapes::leg_origin);
}

void expect_unchanged(const PointMap& a, const PointMap& b) {
    for (std::size_t v = 0; v < a.size(); ++v) {
        ASSERT_EQ(a[v].face, b[v].face);
        ASSERT_EQ(a[v].barycentric, b[v].barycentric);
    }
}

TEST(MissedParts, ACrushedLimbIsTakenFromTheOtherDirection) {
    LostLegTrial trial(crushed);
    const double before = trial.error();
    ASSERT_TRUE(trial.recover(shapes::at_vertices(trial.rest)));
    EXPECT_LT(trial.error(), 0.3 * shapes::longest_edge(trial.posed));
    EXPECT_GT(before, shapes::longest_edge(trial.posed));
    int reversed = 0;
    for (int f = 0; f < trial.rest.face_count(); ++f)
        reversed += trial.leg[std::size_t(trial.rest.faces(f, 0))] && trial.map.image_triangle(f).D <= 0;
    EXPECT_EQ(reversed, 0);
}

TEST(MissedParts, ALimbIsNotGivenUpForOneThatIsCrushed) {
    LostLegTrial trial([](const Vec3& p) { return p; });
    const PointMap before = trial.map.points();
    EXPECT_FALSE(trial.recover(shapes::with_leg(trial.rest, crushed)));
    expect_unchanged(trial.map.points(), before);
}

TEST(MissedParts, DirectionsThatAgreeStay) {
    LostLegTrial trial([](const Vec3& p) { return p; });
    const PointMap before = trial.map.points();
    EXPECT_FALSE(trial.recover(shapes::at_vertices(trial.rest)));
    expect_unchanged(trial.map.points(), before);
}

TEST(MissedParts, FixedVerticesStay) {
    LostLegTrial trial(crushed);
    int tip = 0;
    for (int v = 0; v < trial.rest.vertex_count(); ++v)
        if (trial.leg[std::size_t(v)] && trial.rest.vertices(v, 2) < trial.rest.vertices(tip, 2)) tip = v;
    trial.fixed[tip] = true;
    const Vec3 before = trial.map.image(tip);
    trial.recover(shapes::at_vertices(trial.rest));
    EXPECT_EQ(trial.map.image(tip), before);
}

}  // namespace
}  // namespace varimap
